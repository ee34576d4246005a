#include "app/plots/cutting.h"

#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/plot_time.h"
#include "core/plot/path_file.h"
#include "core/plot/picture/finished_look.h"
#include "core/plot/plot_program.h"
#include "core/plot/work_time.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace millwright::app {

void add_cutting_options(CLI::App& command, CuttingOptions& options) {
    command.add_option("--machine", options.machine, "Shipped machine or machine file")
        ->capture_default_str();
    add_feed_options(command, options.feed_mm_per_min, options.plunge_mm_per_min);
    command.add_option("--safe-height", options.safe_height, "Safe height above the top of the work, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_spindle_option(command, options.spindle_rpm);
    add_post_options(command, options.post).capture_default_str();
    add_drawing_origin(command, options.origin);
    command.add_option("--path", options.path_file, "Also write the path to this file: X, Y, Z, speed")
        ->type_name("FILE");
    PreviewOptions& preview = options.preview;
    constexpr int most_pixels = 10'000;
    command.add_option("--preview", preview.file, "PNG file for a preview of the finished work")
        ->type_name("FILE");
    command.add_option("--preview-size", preview.pixels, "Pixels on the longer side of the preview")
        ->check(CLI::Range(1, most_pixels))
        ->capture_default_str();
    command.add_flag(
        "--against-light", preview.against_light, "Backlit preview: light shining through the plate");
    command.add_option("--plate", preview.plate, "Plate thickness, mm; also limits the depth of cut")
        ->check(above_zero());
    command.add_flag("--through", preview.through, "Allow cuts deeper than the plate");
    command
        .add_option(
            "--half-light", preview.half_light, "Thickness of the plate material that halves the light, mm")
        ->check(above_zero())
        ->capture_default_str();
}

void add_drawing_origin(CLI::App& command, std::vector<double>& origin) {
    command.add_option("--origin", origin, "Drawing origin in machine coordinates: X,Y, mm")
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y")
        ->allow_extra_args(false);
}

kinematics::MachineModel machine_of(const CuttingOptions& options) {
    return kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder()));
}

namespace {

Vec3 origin_of(const CuttingOptions& options) {
    return origin_from(options.origin).at();
}

plot::CutPath placed(plot::CutPath path, const Vec3& origin) {
    for (plot::CutPoint& point : path) {
        point.at += origin;
    }
    return path;
}

plot::ToolTips tips_with(const plot::ToolTip& usual, const PreviewOptions& preview) {
    plot::ToolTips tips{usual, {}};
    for (const auto& [tool, diameter] : preview.tool_diameters) {
        tips.others[tool] = {.kind = plot::TipKind::flat, .diameter = diameter};
    }
    return tips;
}

program::Program program_of(const plot::CutPath& path,
                            const kinematics::MachineModel& machine,
                            const CuttingOptions& options,
                            const std::vector<std::string>& header,
                            const std::optional<plot::ToolTip>& tip) {
    plot::PlotProgramSettings settings;
    if (tip) {
        settings.tips = tips_with(*tip, options.preview);
    }
    settings.machine = machine.name();
    settings.axes = plot::plot_axes(machine);
    settings.spindle_rpm = options.spindle_rpm;
    settings.header = header;
    const plot::CutPath on_machine = placed(path, origin_of(options));
    plot::expect_on_table(on_machine, machine, origin_of(options).head<2>());
    return plot::plot_program(on_machine, settings);
}

std::string preview_of(const plot::CutPath& path,
                       const PreviewOptions& preview,
                       const plot::ToolTip& tip,
                       const Progress& progress) {
    const plot::HeightField field =
        plot::finished_by(path, tips_with(tip, preview), preview.pixels, progress);
    constexpr double spare = 0.5;
    const double plate = preview.plate.value_or(spare - static_cast<double>(std::ranges::min(field.z)));
    return plot::png_bytes(preview.against_light ? plot::against_light(field, plate, preview.half_light)
                                                 : plot::shaded(field, plate));
}

PostedText posted_text(const plot::CutPath& path,
                       const kinematics::MachineModel& machine,
                       const CuttingOptions& options,
                       const std::vector<std::string>& header,
                       const std::optional<plot::ToolTip>& tip) {
    return posted(program_of(path, machine, options, header, tip),
                  machine,
                  options.post,
                  std::filesystem::path(options.out).stem().string());
}

double seconds_of(const PostedText& text,
                  const kinematics::MachineModel& machine,
                  const CuttingOptions& options,
                  const Progress& progress) {
    return plan::seconds_of_text(text.text, text.format, machine, options.out, progress);
}

} // namespace

double planned_seconds(const plot::CutPath& path, const CuttingOptions& options, const Progress& progress) {
    const kinematics::MachineModel machine = machine_of(options);
    return seconds_of(posted_text(path, machine, options, {}, std::nullopt), machine, options, progress);
}

WrittenProgram write_program_files(const plot::CutPath& path,
                                   const CuttingOptions& options,
                                   const plot::ToolTip& tip,
                                   const std::vector<std::string>& header,
                                   const Progress& progress,
                                   std::optional<double> seconds) {
    if (path.empty()) {
        throw Error("there is nothing to cut");
    }
    if (options.preview.plate && !options.preview.through) {
        plot::expect_within_plate(path, *options.preview.plate);
    }
    const kinematics::MachineModel machine = machine_of(options);
    const PostedText text = posted_text(path, machine, options, header, tip);
    const std::string preview =
        options.preview.file.empty() ? "" : preview_of(path, options.preview, tip, progress.part(0.2, 0.6));
    progress.check();
    write_file(options.out, text.text.listing.text);
    if (!options.path_file.empty()) {
        write_file(options.path_file, plot::path_file_text(placed(path, origin_of(options))));
    }
    if (!preview.empty()) {
        write_file(options.preview.file, preview);
    }
    print_notes(text);
    if (const auto slower = plot::speeds_not_reached(path, machine)) {
        fmt::print(stderr, "millwright: {}\n", to_text(*slower));
    }
    if (!seconds) {
        seconds = seconds_of(text, machine, options, progress.part(0.6, 1.0));
    }
    return {path.size(),
            static_cast<std::size_t>(text.text.listing.line_count()),
            plot::lengths(placed(path, origin_of(options))),
            *seconds,
            machine.name()};
}

void print_program(const WrittenProgram& written) {
    constexpr double m = 1e-3;
    fmt::print("{}: {:.3f} m at feed rate, {:.3f} m at rapid, lifts included\n",
               counted(written.points, "point"),
               m * written.lengths.cut,
               m * written.lengths.travel);
    fmt::print("{}, {} on {}\n",
               counted(written.lines, "line"),
               plot::time_for_people(written.seconds),
               written.machine);
}

void write_program(const plot::CutPath& path,
                   const CuttingOptions& options,
                   const plot::ToolTip& tip,
                   const std::vector<std::string>& header,
                   const Progress& progress,
                   std::optional<double> seconds) {
    print_program(write_program_files(path, options, tip, header, progress, seconds));
}

} // namespace millwright::app
