#include "app/commands/picture_relief.h"

#include "app/cutting.h"
#include "app/picture_choice.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot/picture/relief.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace millwright::app {

namespace {

struct Options {
    PictureChoice picture;
    CuttingOptions cutting;
    double depth = 1.0;
    std::string tool = "ball:1.0";
    std::optional<double> step_over;
    double merge = 0.005;
    std::optional<double> depth_per_pass;
    double allowance = 0.2;
    std::optional<double> rough_step_over;
    std::optional<double> frame; ///< thickness of the plate
    double frame_margin = 1.0;
    plot::Tabs tabs = {.count = 4};
};

/// Rows of a tool with a width leave ridges: a tenth of it apart, a ball's are a 400th of it high.
double usual_step_over(const plot::ToolTip& tip, double pitch) {
    constexpr double part = 0.1;
    const bool wide = tip.kind == plot::TipKind::ball || tip.kind == plot::TipKind::flat;
    return wide ? part * tip.diameter : pitch;
}

plot::ReliefSettings settings_of(const Options& options, const plot::ToolTip& tip, double pitch) {
    plot::ReliefSettings settings;
    settings.tip = tip;
    settings.step_over = options.step_over.value_or(usual_step_over(tip, pitch));
    settings.merge_tolerance = options.merge;
    if (options.depth_per_pass) {
        settings.roughing =
            plot::Roughing{*options.depth_per_pass, options.allowance, options.rough_step_over};
    }
    settings.cutting = from_mm_per_min(options.cutting.feed_mm_per_min);
    settings.plunging = from_mm_per_min(options.cutting.plunge_mm_per_min);
    settings.safe_height = options.cutting.safe_height;
    return settings;
}

/// Around the picture through the plate, in passes that are no deeper than those of the relief.
plot::CutPath
frame_path(const Options& options, const plot::HeightField& field, const plot::ReliefSettings& relief) {
    if (relief.tip.kind == plot::TipKind::point) {
        throw Error("a point without a diameter cuts no frame", {}, "name the tool, as ball:1.0");
    }
    const plot::Strokes strokes = {plot::frame(field, relief.tip.diameter, options.frame_margin)};
    plot::Level level;
    level.depth = *options.frame;
    const double per_pass =
        options.depth_per_pass.value_or(std::max(options.depth, relief.tip.diameter / 2.0));
    level.passes = std::max(1, static_cast<int>(std::ceil(level.depth / per_pass)));
    level.cutting = relief.cutting;
    level.plunging = relief.plunging;
    level.tabs = options.tabs;
    plot::CutSettings settings;
    settings.levels = {level};
    settings.safe_height = relief.safe_height;
    return plot::cut_path(strokes, settings);
}

int relief(const Options& options) {
    const plot::ToolTip tip = plot::parse_tool_tip(options.tool);
    const SizedPicture sized = read_chosen(options.picture);
    const plot::HeightField field = plot::height_field(sized.picture, sized.pitch, options.depth);
    const plot::ReliefSettings settings = settings_of(options, tip, sized.pitch);
    plot::CutPath path = plot::relief(field, settings);
    if (options.frame) {
        const plot::CutPath around = frame_path(options, field, settings);
        path.insert(path.end(), around.begin(), around.end());
    }
    const plot::PathLengths lengths = plot::lengths(path);
    fmt::print("{} points, cuts {:.3f} m, {:.3f} m in the air\n",
               path.size(),
               lengths.cut / 1000.0,
               lengths.travel / 1000.0);
    write_program(path,
                  options.cutting,
                  tip,
                  {"relief: " + std::filesystem::path(options.picture.file).filename().string(),
                   fmt::format("{:.3f} mm deep, tool {}", options.depth, plot::to_text(tip))});
    return 0;
}

} // namespace

void add_picture_relief(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *group.add_subcommand("relief", "Cut it as deep as its pixels are bright");
    add_picture_options(command, options->picture);
    command.add_option("--depth", options->depth, "Of white, mm")->required();
    command.add_option("--tool", options->tool, "ball:MM, flat:MM, v:DEGREES[:MM] or point")
        ->capture_default_str();
    command.add_option("--out", options->cutting.out, "G-code file")->required();
    command.add_option("--step-over", options->step_over, "Between rows, mm");
    command.add_option("--merge", options->merge, "Join moves that stay so near above the path, mm")
        ->capture_default_str();
    command.add_option("--depth-per-pass", options->depth_per_pass, "Rough in passes so deep, mm");
    command.add_option("--allowance", options->allowance, "Roughing leaves so much, mm")
        ->capture_default_str();
    command.add_option("--rough-step-over", options->rough_step_over, "Between rows of roughing, mm");
    command.add_option("--frame", options->frame, "Cut it out of a plate so thick, mm");
    command.add_option("--frame-margin", options->frame_margin, "Between picture and frame, mm")
        ->capture_default_str();
    command.add_option("--tabs", options->tabs.count, "That hold the frame")->capture_default_str();
    command.add_option("--tab-width", options->tabs.width, "mm")->capture_default_str();
    command.add_option("--tab-height", options->tabs.height, "mm")->capture_default_str();
    add_cutting_options(command, options->cutting);
    command.callback([&chosen, options] { chosen = [options] { return relief(*options); }; });
}

} // namespace millwright::app
