#include "app/plots/plot_program.h"

#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/plots/other_than_plot.h"
#include "app/plots/plot_points.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/gcode/tool_comments.h"
#include "core/plot/decode.h"
#include "core/plot/work_time.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <utility>

namespace millwright::app {

namespace {

using gcode::CutLevel;
using gcode::CutProgram;

constexpr std::array plots_alone{"--unit", "--fill", "--solid", "--line-ends", "--strict"};
constexpr std::array programs_alone{"--tools", "--chord-length", "--work-origin", "--parameters"};
/// Of `toolpath`: what strokes alone can be given.
constexpr std::array shaping_strokes{
    "--side", "--hatch", "--contours", "--order", "--link", "--depth", "--passes", "--level", "--tabs"};
/// Of `toolpath`: what is not as the program has it.
constexpr std::array shaping{"--side",
                             "--hatch",
                             "--contours",
                             "--order",
                             "--link",
                             "--depth",
                             "--passes",
                             "--level",
                             "--tabs",
                             "--feed",
                             "--plunge",
                             "--safe-height"};

bool given(const CLI::App& command, const char* option) {
    const CLI::Option* found = command.get_option_no_throw(option);
    return found != nullptr && found->count() > 0;
}

void expect_none_of(std::span<const char* const> options, const CLI::App& command, const char* whose) {
    for (const char* option : options) {
        if (given(command, option)) {
            throw UsageError(fmt::format("{} applies only to {}", option, whose));
        }
    }
}

CutProgram read_cut_program(const std::string& file, const ProgramReading& reading) {
    gcode::CutProgramSettings settings;
    if (!reading.tools.empty()) {
        settings.tools = gcode::read_tool_table(reading.tools);
    }
    settings.chord_length = reading.chord_length;
    settings.chord_tolerance = reading.chord_tolerance.value_or(settings.chord_tolerance);
    settings.safe_height = reading.safe_height;
    if (!reading.parameters.empty()) {
        settings.parameters = gcode::read_parameter_file(reading.parameters);
    }
    if (!reading.origin.empty()) {
        settings.origin = origin_from(reading.origin);
    }
    return gcode::read_cut_program_file(file, settings);
}

void print_program_notices(const CutProgram& program) {
    for (const Diagnostic& notice : program.notices) {
        fmt::print(stderr, "millwright: {}\n", to_text(notice));
    }
}

CutProgram read_cut_program_to_use(const std::string& file, const ProgramReading& reading) {
    CutProgram program = read_cut_program(file, reading);
    print_program_notices(program);
    return program;
}

/// That is to be cut. Throws Error if it is unknown where it would go.
CutProgram read_cut_program_to_cut(const std::string& file, const ProgramReading& reading) {
    CutProgram program = read_cut_program(file, reading);
    if (!program.unplaced.empty()) {
        throw Error(program.unplaced.front());
    }
    print_program_notices(program);
    return program;
}

std::string count_and_noun(std::size_t count, std::string_view one) {
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::size_t tool_count(const CutProgram& program) {
    std::set<int> tools;
    for (const CutLevel& level : program.levels) {
        tools.insert(level.tool);
    }
    return tools.size();
}

std::string strokes_of_levels(const CutProgram& program) {
    const std::string heights =
        program.uneven ? "varying heights" : count_and_noun(program.levels.size(), "level");
    return fmt::format("{} at {}, {}",
                       count_and_noun(program.strokes.size(), "stroke"),
                       heights,
                       count_and_noun(tool_count(program), "tool"));
}

/// As fast as programmed; rapids as fast as the machine of the thesis travels.
double seconds_of(const CutProgram& program) {
    return program.feed_time + program.dwell_time +
           gcode::named_lengths(program).travel / plot::TimeModel().travelling;
}

/// Lowest and highest of what is cut.
std::array<double, 2> heights_of(const CutProgram& program) {
    std::array<double, 2> heights{};
    bool first = true;
    for (const plot::CutPoint& point : program.path) {
        if (point.move == plot::CutMove::cut || point.move == plot::CutMove::plunge) {
            heights =
                first ? std::array{point.at.z(), point.at.z()}
                      : std::array{std::min(heights[0], point.at.z()), std::max(heights[1], point.at.z())};
            first = false;
        }
    }
    return heights;
}

std::string air_of(const CutProgram& program) {
    return program.safe_height
               ? fmt::format("feed moves across from z {:.3f} mm up are travel", *program.safe_height)
               : "every feed move across is a cut";
}

nlohmann::ordered_json or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json cut_program_json(const CutProgram& program) {
    nlohmann::ordered_json answer;
    answer["commands"] = program.lines;
    answer["pens"] = nlohmann::ordered_json::array();
    const auto box = plot::extents(program.strokes);
    answer["extents_mm"] = {box->lower.x(), box->lower.y(), box->upper.x(), box->upper.y()};
    answer["z_mm"] = heights_of(program);
    const plot::WorkTime time = plot::work_time(program.strokes, {}, Vec2::Zero(), program.end);
    const plot::PathLengths lengths = gcode::named_lengths(program);
    answer["draw_mm"] = time.cut_length;
    answer["air_mm"] = time.travel_length;
    answer["lifts"] = time.runs;
    answer["time_s"] = seconds_of(program);
    answer["strokes"] = program.strokes.size();
    answer["feed_mm"] = lengths.cut;
    answer["feed_s"] = program.feed_time;
    answer["rapid_mm"] = lengths.travel;
    answer["travel_z_mm"] = or_null(program.safe_height);
    answer["pen_use"] = nlohmann::ordered_json::array();
    for (const CutLevel& level : program.levels) {
        double length = 0.0;
        for (const plot::Stroke& stroke : program.strokes) {
            length += stroke.pen == level.pen ? plot::length(stroke) : 0.0;
        }
        answer["pens"].push_back(level.pen);
        answer["pen_use"].push_back({{"pen", level.pen},
                                     {"draw_mm", length},
                                     {"speed_mm_s", level.cutting},
                                     {"tool", level.tool},
                                     {"z_mm", or_null(level.z)}});
    }
    answer["diagnostics"] = nlohmann::ordered_json::array();
    for (const Diagnostic& notice : program.notices) {
        answer["diagnostics"].push_back({{"line", notice.place.line}, {"message", notice.message}});
    }
    return answer;
}

/// As the program cuts each pen, but for what was asked for. Throws Error where that is no depth.
std::vector<plot::Level>
levels_of(const CutProgram& program, const StrokeCutting& cutting, const CLI::App& command) {
    std::vector<plot::Level> levels;
    for (const CutLevel& cut : program.levels) {
        plot::Level level;
        level.pen = cut.pen;
        level.tool = cut.tool;
        level.passes = cutting.passes;
        level.tabs = cutting.tabs;
        level.depth = given(command, "--depth") ? cutting.depth : -cut.z.value_or(0.0);
        level.cutting =
            given(command, "--feed") ? from_mm_per_min(cutting.cutting.feed_mm_per_min) : cut.cutting;
        level.plunging =
            given(command, "--plunge") ? from_mm_per_min(cutting.cutting.plunge_mm_per_min) : cut.plunging;
        if (level.depth < 0.0) {
            throw Error(fmt::format("it cuts at z {:.3f} mm, above the top of the work", *cut.z),
                        {},
                        "give --depth, or leave out options that shape strokes to cut it unchanged");
        }
        levels.push_back(level);
    }
    return levels;
}

/// The greatest height at which it goes across in the air, mm: nothing tells what it stays above there.
double travel_height(const plot::CutPath& path) {
    double height = path.front().at.z();
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec3& from = path[n - 1].at;
        const Vec3& to = path[n].at;
        if (path[n].move == plot::CutMove::rapid && to.head<2>() != from.head<2>()) {
            height = std::max(height, std::min(from.z(), to.z()));
        }
    }
    return height;
}

/// The usual one, or as high as the program travels.
double safe_height_of(const CutProgram& program, const std::string& file) {
    const double usual = project::PlotSettings().safe_height;
    const double height = travel_height(program.path);
    if (height > usual) {
        fmt::print(stderr,
                   "millwright: {}: the tool travels at {:.3f} mm, as high as in the program; set another "
                   "height with --safe-height\n",
                   file,
                   height);
    }
    return std::max(usual, height);
}

void expect_even(const CutProgram& program, const char* option) {
    if (program.uneven) {
        Diagnostic found = *program.uneven;
        found.message += fmt::format(": {} applies only to strokes of constant height", option);
        found.hint = "leave out options that shape strokes to cut it unchanged, with its heights";
        throw Error(found);
    }
}

/// As CAM programs name their tools.
void take_diameter_of_comments(const std::string& file, StrokeCutting& cutting) {
    const auto tools = gcode::tools_in_comments(read_file(file));
    if (const auto tool = gcode::only_tool(tools)) {
        cutting.plan.tool_diameter = tool->diameter;
        fmt::print(stderr,
                   "millwright: {}:{}: the tool diameter is {} mm according to a comment (--tool-diameter "
                   "sets another)\n",
                   file,
                   tool->line,
                   shortest(tool->diameter));
    } else if (!tools.empty()) {
        throw Error(Diagnostic{{file, tools.back().line, 0, -1},
                               "comments name tools of several diameters, but only one cutter is used here",
                               "give its diameter (--tool-diameter), or one program for each tool"});
    }
}

} // namespace

void add_program_options(CLI::App& command, ProgramReading& reading) {
    constexpr double shortest_chord = 1e-3;
    constexpr double longest_chord = 1e3;
    command
        .add_option("--chord-length",
                    reading.chord_length,
                    "G-code programs: divide arcs into equal chords no longer than this, mm")
        ->check(CLI::Range(shortest_chord, longest_chord));
    command.add_option("--tools", reading.tools, "G-code programs: LinuxCNC tool table file")
        ->type_name("FILE");
    command.add_option("--parameters", reading.parameters, "G-code programs: LinuxCNC parameter file")
        ->type_name("FILE");
    add_origin_option(command, reading.origin, "--work-origin");
}

bool takes_points(const CLI::App& command, const std::string& file) {
    if (!is_point_file(file)) {
        return false;
    }
    const auto points_have = "plots and programs; this file contains points of a table";
    expect_none_of(plots_alone, command, points_have);
    expect_none_of(programs_alone, command, points_have);
    expect_none_of(shaping_strokes, command, points_have);
    return true;
}

bool takes_program(const CLI::App& command, const std::string& file) {
    expect_no_other_than_plot(file);
    if (is_gcode_file(file)) {
        expect_none_of(plots_alone, command, "HPGL plots; this is a G-code program");
        if (given(command, "--chord-length") && given(command, "--arc-tolerance")) {
            throw UsageError("--chord-length and --arc-tolerance are two ways to divide an arc: give one");
        }
        return true;
    }
    expect_none_of(programs_alone, command, "G-code programs");
    return false;
}

int program_info(const std::string& file, const ProgramReading& reading, bool json) {
    if (json) {
        fmt::print("{}\n",
                   cut_program_json(read_cut_program(file, reading))
                       .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        return 0;
    }
    const CutProgram program = read_cut_program_to_use(file, reading);
    const plot::WorkTime time = plot::work_time(program.strokes, {}, Vec2::Zero(), program.end);
    const plot::PathLengths lengths = gcode::named_lengths(program);
    const auto box = plot::extents(program.strokes);
    const auto [low, high] = heights_of(program);
    fmt::print("{}, {}\n",
               count_and_noun(static_cast<std::size_t>(program.lines), "line"),
               strokes_of_levels(program));
    fmt::print("x {:.3f} to {:.3f} mm, y {:.3f} to {:.3f} mm, z {:.3f} to {:.3f} mm\n",
               box->lower.x(),
               box->upper.x(),
               box->lower.y(),
               box->upper.y(),
               low,
               high);
    fmt::print("{}\n{}\n", air_of(program), way_for_people(time));
    constexpr double m = 1e-3;
    fmt::print("{:.3f} m at feed rate in {}, {:.3f} m at rapid; {} with rapids of {:.0f} mm/s\n",
               m * lengths.cut,
               plot::time_for_people(program.feed_time),
               m * lengths.travel,
               plot::time_for_people(seconds_of(program)),
               plot::TimeModel().travelling);
    return 0;
}

int program_view(const std::string& file,
                 const ProgramReading& reading,
                 plot::AirInSvg air,
                 const std::string& out) {
    const CutProgram program = read_cut_program_to_use(file, reading);
    write_file(out, plot::svg_text(program.strokes, air));
    fmt::print("{}\n", strokes_of_levels(program));
    return 0;
}

std::vector<Vec3> program_points(const std::string& file,
                                 const ProgramReading& reading,
                                 plot::DecodeSettings decoding,
                                 const std::optional<double>& fastest,
                                 bool flat) {
    const CutProgram program = read_cut_program_to_cut(file, reading);
    if (std::ranges::find(program.path, plot::CutMove::tool_change, &plot::CutPoint::move) !=
        program.path.end()) {
        fmt::print(stderr,
                   "millwright: {}: {} tools: points have no tool change, and continue without one\n",
                   file,
                   tool_count(program));
    }
    if (flat) {
        decoding.end = program.end;
        return fastest ? plot::decode_within(*fastest, program.strokes, decoding)
                       : plot::decode(program.strokes, decoding);
    }
    return plot::decode_path(program.path, decoding, fastest).points;
}

ProgramStrokes program_strokes(const std::string& file, const ProgramReading& reading) {
    CutProgram program = read_cut_program_to_cut(file, reading);
    const double height = reading.safe_height ? *reading.safe_height : safe_height_of(program, file);
    return {std::move(program.strokes), height};
}

int program_toolpath(const std::string& file,
                     const ProgramReading& reading,
                     StrokeCutting cutting,
                     const CLI::App& command) {
    const CutProgram program = read_cut_program_to_cut(file, reading);
    if (!given(command, "--spindle") && program.spindle_rpm > 0.0) {
        cutting.cutting.spindle_rpm = program.spindle_rpm;
    } else if (!given(command, "--spindle")) {
        fmt::print(stderr,
                   "millwright: {}: the program sets no spindle speed: {:.0f} 1/min is used (--spindle)\n",
                   file,
                   cutting.cutting.spindle_rpm);
    }
    if (!given(command, "--tool-diameter")) {
        take_diameter_of_comments(file, cutting);
    }
    const std::vector<std::string> header{"program: " + std::filesystem::path(file).filename().string()};
    const auto* const shaped =
        std::ranges::find_if(shaping, [&](const char* option) { return given(command, option); });
    if (shaped == shaping.end()) {
        write_program(program.path,
                      cutting.cutting,
                      {.kind = plot::TipKind::flat, .diameter = cutting.plan.tool_diameter},
                      header);
        return 0;
    }
    expect_even(program, *shaped);
    cutting.drawn_levels = levels_of(program, cutting, command);
    if (!given(command, "--safe-height")) {
        cutting.cutting.safe_height = safe_height_of(program, file);
    }
    cut_strokes(program.strokes, program.end, cutting, header);
    return 0;
}

} // namespace millwright::app
