#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "app/plots/cutting.h"
#include "app/plots/picture_choice.h"
#include "app/plots/picture_command.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot/picture/relief_plan.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace millwright::app {

namespace {

struct PictureReliefOptions {
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

plot::ReliefPlan plan_of(const PictureReliefOptions& options, const plot::ToolTip& tip) {
    plot::ReliefPlan plan;
    plan.relief.tip = tip;
    plan.relief.step_over = options.step_over;
    plan.relief.merge_tolerance = options.merge;
    if (options.depth_per_pass) {
        plan.relief.roughing =
            plot::Roughing{*options.depth_per_pass, options.allowance, options.rough_step_over};
    }
    plan.relief.cutting = from_mm_per_min(options.cutting.feed_mm_per_min);
    plan.relief.plunging = from_mm_per_min(options.cutting.plunge_mm_per_min);
    plan.relief.safe_height = options.cutting.safe_height;
    plan.plate = options.frame;
    plan.through = options.cutting.preview.through;
    plan.frame_margin = options.frame_margin;
    plan.tabs = options.tabs;
    return plan;
}

void expect_cut(const plot::HeightField& field, const PictureReliefOptions& options) {
    if (plot::is_cut(field) || options.frame) {
        return;
    }
    const bool helps = inverting_helps(options.picture, [&](const SizedPicture& other) {
        return plot::is_cut(plot::height_field(other.picture, other.pitch, options.depth));
    });
    throw Error("all of it is black or transparent: the relief would cut nothing",
                options.picture.file,
                invert_hint(options.picture,
                            helps,
                            {.invert = "use --invert to cut what is dark",
                             .plain = "leave out --invert to cut what is bright"}));
}

int relief(const PictureReliefOptions& options) {
    const plot::ToolTip tip = plot::parse_tool_tip(options.tool);
    WatchedWork work;
    const SizedPicture sized = read_chosen(options.picture, work.progress().part(0.0, 0.2));
    const plot::HeightField field = plot::height_field(sized.picture, sized.pitch, options.depth);
    expect_cut(field, options);
    const plot::ReliefPlan plan = plan_of(options, tip);
    const plot::CutPath path = plot::relief_path(field, plan, work.progress().part(0.2, 0.5));
    work.finish();
    if (const auto notice = plot::frame_notice(plan)) {
        fmt::print(stderr, "millwright: {}\n", to_text(*notice));
    }
    write_program(path,
                  options.cutting,
                  tip,
                  {"relief: " + std::filesystem::path(options.picture.file).filename().string(),
                   fmt::format("{:.3f} mm deep, tool {}", options.depth, plot::to_text(tip))},
                  work.progress().part(0.5, 1.0));
    work.finish();
    return 0;
}

} // namespace

void add_picture_relief(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PictureReliefOptions>();
    options->picture.reading.ground = plot::relief_top;
    CLI::App& command = *group.add_subcommand("relief", "Cut a relief: the brighter the picture, the deeper");
    add_picture_options(command, options->picture);
    command.add_option("--depth", options->depth, "Depth of white, mm")->check(above_zero())->required();
    command.add_option("--tool", options->tool, "Tool: ball:MM, flat:MM, v:DEGREES[:MM[:END]] or point")
        ->check(parsed_by([](const std::string& text) { (void)plot::parse_tool_tip(text); }))
        ->capture_default_str();
    command.add_option("--out", options->cutting.out, "G-code file")->required();
    command.add_option("--step-over", options->step_over, "Step-over between rows, mm")->check(above_zero());
    command.add_option("--merge", options->merge, "Join moves that stay at most this far above the path, mm")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--depth-per-pass", options->depth_per_pass, "Depth per roughing pass, mm")
        ->check(above_zero());
    command.add_option("--allowance", options->allowance, "Stock left by roughing, mm")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--rough-step-over", options->rough_step_over, "Step-over between roughing rows, mm")
        ->check(above_zero());
    command.add_option("--frame", options->frame, "Cut the relief out of a plate of this thickness, mm")
        ->check(above_zero());
    command.add_option("--frame-margin", options->frame_margin, "Distance between picture and frame, mm")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--tabs", options->tabs.count, "Number of tabs that hold the frame")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--tab-width", options->tabs.width, "Tab width, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--tab-height", options->tabs.height, "Tab height, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_cutting_options(command, options->cutting);
    command.callback([&chosen, options] { chosen = [options] { return relief(*options); }; });
}

} // namespace millwright::app
