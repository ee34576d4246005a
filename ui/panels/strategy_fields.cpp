#include "ui/panels/strategy_fields.h"

#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/strategy_path.h"
#include "core/project/tool_settings.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/shown_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace millwright::panels {

namespace {

using project::Project;
using project::StrategyInput;

void scallop_field(Ui& ui, const FrameState& now, ActionQueue& ask) {
    for (const auto& setting : project::tool_numbers()) {
        if (setting.id == "scallop_mm") {
            number_fields<project::ToolInput>(
                ui, ask, {&setting, 1}, now.project.tool, [](Project& p) -> project::ToolInput& {
                    return p.tool;
                });
        }
    }
    if (now.project.tool.cutter == toolpath::CutterKind::point) {
        (void)widgets::banner(
            ui,
            "no_cutter",
            {widgets::Severity::warning, "A point leaves no scallops: select a cutter under Tool.", {}});
    }
}

/// The points are chosen for the tip; what a cutter with a width does beside it they cannot help.
void kept_tolerance(Ui& ui, const FrameState& now) {
    const auto path = now.program_path();
    const std::string why = path ? plan::why_not_kept(now.project, *path) : std::string();
    if (!why.empty()) {
        (void)widgets::banner(ui, "not_kept", {widgets::Severity::warning, as_sentence(why), {}});
    }
}

} // namespace

std::string so_far_note(const plan::Evaluation& evaluation) {
    return actions::is_so_far(evaluation) ? " Preliminary: measured coarsely; the exact values can differ."
                                          : "";
}

std::string grid_note(const FrameState& now) {
    const Project& project = now.project;
    if (plan::follows_nodes(project.toolpath.strategy)) {
        const std::string crossing =
            now.plan ? plan::crossing_remark(now.plan->project, now.plan->plan) : std::string();
        return crossing.empty()
                   ? fmt::format("Grid used: {}.",
                                 project::row_of(project::grid_methods(), project.grid.method).label)
                   : crossing + so_far_note(*now.program_path());
    }
    switch (project.toolpath.strategy) {
    case StrategyInput::constant_scallop:
        return "Only the number of points per track is taken from the grid; the grid method has no effect.";
    case StrategyInput::fewest_points:
        return "Only the number of tracks is taken from the grid; the grid method has no effect.";
    default:
        return "Only the numbers of tracks and points are taken from the grid; the grid method has no "
               "effect.";
    }
}

void strategy_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("strategy", "Strategy");
    if (!section) {
        return;
    }
    const project::ToolpathInput& input = now.project.toolpath;
    const auto [options, index] = options_of(project::strategies(), input.strategy);
    if (const auto chosen = ui.choice("strategy", "Path", index, options)) {
        constexpr std::string_view prefix = "path.";
        std::string id(project::strategies()[static_cast<std::size_t>(*chosen)].id);
        std::ranges::replace(id, '-', '_');
        ask.run(std::string(prefix) + id);
    }
    if (input.strategy == StrategyInput::constant_scallop) {
        scallop_field(ui, now, ask);
    }
    if (input.strategy == StrategyInput::fewest_points) {
        number_fields<project::ToolpathInput>(
            ui, ask, project::toolpath_numbers(), input, [](Project& p) -> project::ToolpathInput& {
                return p.toolpath;
            });
    }
    ui.note(grid_note(now));
    kept_tolerance(ui, now);
    if (const auto path = now.program_path()) {
        const std::string mark = actions::is_so_far(*path) ? "~ " : "";
        ui.value("points",
                 "Points",
                 fmt::format("{}{}", mark, path->toolpath.points.size()),
                 "",
                 "Number of points of the whole path, including those added by the sequencing");
        ui.value("length",
                 "Length",
                 mark + fixed(path->path_length, 1),
                 "mm",
                 "Tool-tip travel, tracks and cross moves");
    }
}

} // namespace millwright::panels
