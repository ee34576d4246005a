#include "app/plots/carving.h"

#include "app/command_line/option_values.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace millwright::app {

namespace {

plot::CarvingSettings settings_of(const CarvingOptions& options) {
    plot::CarvingSettings settings = options.settings;
    settings.tip = plot::parse_tool_tip(options.tool);
    settings.clear_floor = !options.leave_floor;
    settings.cutting = from_mm_per_min(options.cutting.feed_mm_per_min);
    settings.plunging = from_mm_per_min(options.cutting.plunge_mm_per_min);
    settings.safe_height = options.cutting.safe_height;
    return settings;
}

/// With the file that it is about.
plot::Carving carved(const plot::Strokes& drawn,
                     const std::string& file,
                     const CarvingOptions& options,
                     const Progress& progress) {
    try {
        plot::Carving made = plot::v_carving(drawn, settings_of(options), progress);
        for (Diagnostic& notice : made.notices) {
            notice.place.file = file;
        }
        return made;
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        found.place.file = file;
        throw Error(found);
    }
}

void print_json(const plot::Carving& made, const WrittenProgram& written) {
    nlohmann::ordered_json answer;
    answer["parts"] = made.parts;
    answer["area_mm2"] = made.area;
    answer["depth_mm"] = made.deepest;
    answer["cut_mm"] = written.lengths.cut;
    answer["travel_mm"] = written.lengths.travel;
    answer["lifts"] = std::ranges::count(made.path, plot::CutMove::plunge, &plot::CutPoint::move);
    answer["floor_mm2"] = made.floor_area;
    answer["floor_left_mm2"] = made.floor_left;
    answer["ridge_mm"] = made.ridge;
    answer["narrow_mm2"] = made.narrow_area;
    answer["deviation_mm"] = made.deviation;
    answer["points"] = written.points;
    answer["lines"] = written.lines;
    answer["time_s"] = written.seconds;
    answer["diagnostics"] = nlohmann::ordered_json::array();
    for (const Diagnostic& notice : made.notices) {
        answer["diagnostics"].push_back({{"byte", notice.place.byte}, {"message", notice.message}});
    }
    fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace

void add_carving_options(CLI::App& command, CarvingOptions& options) {
    plot::CarvingSettings& settings = options.settings;
    command.add_option("--out", options.cutting.out, "G-code file")->required();
    command
        .add_option("--tool",
                    options.tool,
                    "V-bit: v:DEGREES[:MM[:END]]; END is the width of a flat tip or rRADIUS, mm")
        ->check(parsed_by([](const std::string& text) { (void)plot::parse_tool_tip(text); }))
        ->capture_default_str();
    command
        .add_option("--largest-depth",
                    settings.largest_depth,
                    "Maximum depth, mm (default: as deep as the bit reaches)")
        ->check(above_zero());
    command.add_option("--depth-per-pass", settings.depth_per_pass, "Depth per pass, mm")
        ->check(above_zero());
    command
        .add_option(
            "--step-over",
            settings.step_over,
            "Step-over on floors at the largest depth, mm (default: for ridges of a tenth of the depth)")
        ->check(above_zero());
    command.add_flag(
        "--leave-floor", options.leave_floor, "Leave floors for an end mill, except along their edges");
    command.add_option("--accuracy", settings.tolerance, "Tolerance of position and depth, mm")
        ->check(above_zero())
        ->capture_default_str();
    command
        .add_option(
            "--close-gaps", settings.close_gaps, "Join ends of outlines up to this distance apart, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_flag("--json", options.json, "Print the result as JSON");
    add_cutting_options(command, options.cutting);
}

void carve_strokes(const plot::Strokes& drawn,
                   const std::string& file,
                   const CarvingOptions& options,
                   WatchedWork& work) {
    const Progress progress = work.progress().part(0.2, 1.0);
    const plot::Carving made = carved(drawn, file, options, progress.part(0.0, 0.4));
    work.finish();
    for (const Diagnostic& notice : made.notices) {
        fmt::print(stderr, "millwright: {}\n", to_text(notice));
    }
    const WrittenProgram written =
        write_program_files(made.path,
                            options.cutting,
                            plot::parse_tool_tip(options.tool),
                            {"carved: " + std::filesystem::path(file).filename().string(),
                             fmt::format("{:.3f} mm deep, tool {}", made.deepest, options.tool)},
                            progress.part(0.4, 1.0));
    work.finish();
    if (options.json) {
        print_json(made, written);
        return;
    }
    fmt::print("{} of {:.4g} mm2 carved up to {:.3f} mm deep, at most {:.4f} mm beyond the outlines\n",
               counted(made.parts, "part"),
               made.area,
               made.deepest,
               std::max(0.0, made.deviation));
    print_program(written);
}

} // namespace millwright::app
