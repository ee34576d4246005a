#include "app/plan/plan_command.h"

#include "app/command_line/output_transaction.h"
#include "app/command_line/posting.h"
#include "app/command_line/watched_work.h"
#include "app/plan/gouges.h"
#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/plan/grids.h"
#include "core/plan/report.h"
#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"
#include "core/project/tool_file.h"
#include "core/project/tool_settings.h"
#include "core/toolpath/shortest_sequence.h"
#include "ui/render/picture.h"
#include "ui/viewport/picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using project::GridMethod;

struct PlanOptions {
    std::string project;
    std::string out;
    std::string tool; ///< a tool file; empty: the project's tool
    PostChoice post;
    std::string sequencing; ///< empty: as the project says
    std::optional<double> largest_step_deg;
    bool any_memory = false;
    bool allow_gouges = false;
};

void print_figures(std::string_view name, const plan::Evaluation& evaluation) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               name,
               fixed(evaluation.closest.max, 4),
               fixed(evaluation.closest.mean, 4),
               fixed(evaluation.closest.lmean, 4),
               fixed(to_degrees(evaluation.closest.axis_max), 2),
               evaluation.track_gap ? fixed(*evaluation.track_gap, 3) : "-");
}

/// What is wrong with a grid, also where it is only compared with the program's.
void print_warnings(const plan::Plan& plan) {
    for (const GridMethod method : project::every_grid_method) {
        const std::string_view id = project::row_of(project::grid_methods(), method).id;
        if (const auto& failure = plan.grid(method).failure) {
            fmt::print(stderr, "warning: no {} grid to compare with: {}\n", id, to_text(*failure));
        }
        const auto& evaluation = plan.grid(method).evaluation;
        if (evaluation && !evaluation->outcome.warning.empty()) {
            fmt::print(stderr, "warning: {} grid: {}\n", id, evaluation->outcome.warning);
        }
    }
}

/// Why the uniform grid is kept, whose figures stand there then, and whose grid the whole chain took.
void print_plan_notes(const plan::Plan& plan) {
    for (const GridMethod method : project::every_grid_method) {
        const auto& evaluation = plan.grid(method).evaluation;
        const bool kept =
            evaluation && plan::keeps_grid(*evaluation, *plan.grid(GridMethod::uniform).evaluation);
        if (method == GridMethod::uniform || !(kept || method == GridMethod::chain) || !evaluation ||
            evaluation->outcome.note.empty()) {
            continue;
        }
        fmt::print("{}{}: {}\n",
                   kept ? "no gain: " : "",
                   project::row_of(project::grid_methods(), method).id,
                   evaluation->outcome.note);
    }
}

/// What each link of the whole chain brought, by the distance from the surface curve.
void print_links(const plan::Plan& plan) {
    if (!plan.grid(GridMethod::chain).evaluation) {
        return;
    }
    const bool turns = !plan.cutting_setup->machine.rotary_axes().empty();
    const auto figure = [](double value, int decimals) { // of nodes that are never cut there may be none
        return std::isfinite(value) ? fixed(value, decimals) : std::string("-");
    };
    const auto axis = [&](const grid::ErrorSummary& of) {
        return turns ? figure(to_degrees(of.axis_max), 2) : std::string("-");
    };
    fmt::print("{:<40} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               "stage of the chain, error to the curve",
               "max mm",
               "mean mm",
               "axis deg",
               "best max",
               "best mean",
               "best axis");
    for (const grid::ChainStage& stage : plan.grid(GridMethod::chain).evaluation->outcome.stages) {
        fmt::print("{:<40} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}{}\n",
                   stage.name,
                   figure(stage.reached.max, 4),
                   figure(stage.reached.mean, 4),
                   axis(stage.reached),
                   figure(stage.of_best.max, 4),
                   figure(stage.of_best.mean, 4),
                   axis(stage.of_best),
                   stage.refused.empty() ? std::string() : "  not used: " + stage.refused);
    }
}

void print_plan_summary(const plan::Plan& plan, const project::Project& project) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               "grid",
               "max mm",
               "mean mm",
               "lmean mm",
               "axis deg",
               "gap mm");
    for (const GridMethod method : project::every_grid_method) {
        const std::string_view id = project::row_of(project::grid_methods(), method).id;
        if (const auto& evaluation = plan.grid(method).evaluation) {
            print_figures(id, *evaluation);
        } else if (plan.grid(method).failure) {
            fmt::print("{:<10} failed\n", id);
        } else if (plan::is_comparison_skipped(project, method)) {
            fmt::print("{:<10} skipped\n", id);
        }
    }
    if (plan::has_own_path(project)) {
        print_figures("path", *plan.path);
    }
    fmt::print("distances: {}\n", plan::checked_text(project));
    print_plan_notes(plan);
    if (const std::string left_out = plan::skipped_comparisons_sentence(project); !left_out.empty()) {
        fmt::print("{}\n", left_out);
    }
    print_links(plan);
    const plan::Evaluation& chosen = *plan.program_path(project);
    if (project.toolpath.strategy != project::StrategyInput::zigzag) {
        fmt::print("strategy: {}\n", plan::strategy_text(project));
    }
    fmt::print("tool: {}\n", project::tool_text(project.tool));
    fmt::print("tool length: {}\n", project::tool_length_text(project.tool, plan.cutting_setup->machine));
    fmt::print("{}, path {} mm, estimated time {}\n",
               counted(chosen.toolpath.points.size(), "point"),
               fixed(chosen.path_length, 1),
               clock_time(plan.trajectory->duration()));
}

/// With what the command line says of the tool and the rotary axes.
project::Project changed(project::Project project, const PlanOptions& options) {
    if (!options.tool.empty()) {
        project.tool = project::read_tool(options.tool);
    }
    for (const auto& goal : project::sequencing_goals()) {
        if (goal.id == options.sequencing) {
            project.sequencing.goal = goal.value;
        }
    }
    project.sequencing.largest_step_deg =
        options.largest_step_deg.value_or(project.sequencing.largest_step_deg);
    project.grid.elliptic.any_memory = project.grid.elliptic.any_memory || options.any_memory;
    return project;
}

void print_path(std::string_view name,
                const plan::CuttingSetup& cutting_setup,
                const plan::Evaluation& of,
                const std::optional<double>& time) {
    const double step =
        toolpath::largest_rotary_step(cutting_setup.machine, of.toolpath, of.axes, toolpath::MoveKind::track);
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>13} {:>13} {:>9}\n",
               name,
               of.toolpath.points.size(),
               fixed(of.closest.max, 4),
               fixed(of.closest.mean, 4),
               fixed(to_degrees(of.closest.axis_max), 2),
               fixed(to_degrees(of.axes.rotary_travel), 1),
               fixed(to_degrees(step), 2),
               time ? fixed(*time, 1) : std::string("-"));
}

/// The path of the chosen grid beside the one of the nearest angles with no point added.
void print_sequencing(const plan::Plan& plan, const project::Project& project) {
    if (plan.unsequenced_failure) {
        fmt::print(stderr,
                   "note: the program with nearest angles, to compare with, could not be computed: {}\n",
                   to_text(*plan.unsequenced_failure));
        return;
    }
    if (!plan.unsequenced) {
        return;
    }
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>13} {:>13} {:>9}\n",
               "sequence",
               "points",
               "max mm",
               "mean mm",
               "axis deg",
               "rotation deg",
               "in a cut deg",
               "time s");
    print_path("before", *plan.cutting_setup, *plan.unsequenced, plan.unsequenced_time);
    print_path(project::row_of(project::sequencing_goals(), project.sequencing.goal).id,
               *plan.cutting_setup,
               *plan.program_path(project),
               plan.trajectory->duration());
}

void print_cut(const project::Project& project, const plan::Plan& plan) {
    const plan::CutStudy& cut = *plan.cut;
    fmt::print("scallop height: {}; deepest cut below the surface: {} mm ({})\n",
               plan::left_text(project, plan),
               fixed(cut.deepest, 4),
               plan::checked_text(project));
    if (const std::string why = plan::why_higher(project, plan); !why.empty()) {
        fmt::print(stderr, "warning: {}\n", why);
    }
    if (!cut.local_gouges.empty()) {
        fmt::print(stderr,
                   "warning: the surface is too tightly curved for the cutter at {}; `millwright cutter` "
                   "lists them\n",
                   counted(cut.local_gouges.size(), "node"));
    }
}

/// Nullopt, with a warning, on a computer without OpenGL: the program is worth having without its picture.
std::optional<render::Picture> preview_of_plan(const project::Project& project, const plan::Plan& plan) {
    constexpr render::PixelSize preview_size{1280, 800};
    try {
        return viewport::render_view(
            project, plan, viewport::ViewKind::error, preview_size, render::Theme::dark);
    } catch (const Error& error) {
        fmt::print(stderr, "warning: no preview.png: {}\n", to_text(error.diagnostic()));
        return std::nullopt;
    }
}

int plan(const PlanOptions& options) {
    const Interrupt interrupt;
    OpenedProject opened = open_project(options.project);
    opened.project = changed(std::move(opened.project), options);
    const OutputFolder folder(options.out);
    const plan::Plan plan = planned(opened, plan::Scope::report, interrupt.token());
    const PostedText text =
        posted(*plan.program, plan.cutting_setup->machine, options.post, opened.file.stem().string());
    const std::string gouges = gouges_of(opened, plan);
    const bool writes = gouges.empty() || options.allow_gouges;
    const std::string program = "program." + text.format.extension;
    OutputSet set{{{"report.json", plan::report_text(opened.project, plan)}}, {}, std::string(program_kind)};
    const auto add = [&set](const std::string& name, std::optional<std::string> bytes) {
        if (bytes) {
            set.files.push_back({name, std::move(*bytes)});
        } else { // an older one would be taken for it
            set.absent.push_back(name);
        }
    };
    add(program, writes ? std::optional(text.text.listing.text) : std::nullopt);
    const std::optional<render::Picture> preview = preview_of_plan(opened.project, plan);
    add("preview.png", preview ? std::optional(render::to_png(*preview)) : std::nullopt);
    write_outputs(options.out, set, opened.file);
    print_notes(text);
    print_warnings(plan);
    print_plan_summary(plan, opened.project);
    print_sequencing(plan, opened.project);
    for (const std::string& remark : plan::path_remarks(opened.project, plan)) {
        fmt::print(stderr, "warning: {}\n", remark);
    }
    if (plan.cut) {
        print_cut(opened.project, plan);
    }
    answer_for_gouges(opened, gouges, options.allow_gouges, program + " was not written");
    return 0;
}

} // namespace

void add_plan_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<PlanOptions>();
    CLI::App& command =
        *app.add_subcommand("plan", "Generate the program of a project, with a report and a picture");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for program, report.json and preview.png")
        ->required()
        ->type_name("DIR");
    command.add_option("--tool", options->tool, "Tool file to use instead of the project's tool")
        ->type_name("FILE");
    std::vector<std::string> goals;
    for (const auto& goal : project::sequencing_goals()) {
        goals.emplace_back(goal.id);
    }
    command
        .add_option(
            "--sequencing", options->sequencing, "How to choose the rotary axis positions along the path")
        ->check(CLI::IsMember(goals));
    command
        .add_option("--largest-step",
                    options->largest_step_deg,
                    "Add points where a rotary axis turns by more than this in one move, degrees (0: none)")
        ->check(CLI::Range(0.0, 180.0));
    command.add_flag("--any-memory",
                     options->any_memory,
                     "Generate an elliptic grid even if it takes more than half of the free memory");
    add_gouges_option(command, options->allow_gouges);
    add_post_options(command, options->post);
    command.callback([&chosen, options] { chosen = [options] { return plan(*options); }; });
}

} // namespace millwright::app
