#include "app/commands/plan_command.h"

#include "app/interrupt.h"
#include "app/outputs.h"
#include "app/posting.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/report.h"
#include "core/project/sequenced_evaluation.h"
#include "core/project/settings.h"
#include "core/toolpath/shortest_sequence.h"
#include "ui/render/picture.h"
#include "ui/viewport/picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

namespace {

using toolpath::SequencingGoal;

struct Options {
    std::string project;
    std::string out;
    PostChoice post;
    std::string sequencing; ///< empty: as it is
    double largest_step_deg = 0.0;
};

struct Goal {
    std::string_view name;
    SequencingGoal goal;
};
constexpr std::array goals{Goal{"nearest", SequencingGoal::nearest},
                           Goal{"travel", SequencingGoal::travel},
                           Goal{"error", SequencingGoal::error},
                           Goal{"time", SequencingGoal::time}};

void print_figures(std::string_view name, const project::Evaluation& evaluation) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               name,
               fixed(evaluation.closest.max, 4),
               fixed(evaluation.closest.mean, 4),
               fixed(evaluation.closest.lmean, 4),
               fixed(to_degrees(evaluation.closest.axis_max), 2),
               fixed(evaluation.track_gap, 3));
}

void print_summary(const project::Plan& plan, const project::Project& project) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               "grid",
               "max mm",
               "mean mm",
               "lmean mm",
               "axis deg",
               "gap mm");
    for (const project::GridMethod method : project::every_grid_method) {
        if (const auto& evaluation = plan.evaluation(method)) {
            print_figures(project::row_of(project::grid_methods(), method).id, *evaluation);
        }
    }
    const project::Evaluation& chosen = *plan.evaluation(project.grid.method);
    fmt::print("{} points, path {} mm, estimated time {}\n",
               chosen.toolpath.points.size(),
               fixed(chosen.path_length, 1),
               clock_time(plan.trajectory->duration()));
}

std::optional<SequencingGoal> goal_named(std::string_view name) {
    const auto found = std::ranges::find(goals, name, &Goal::name);
    return found == goals.end() ? std::nullopt : std::optional(found->goal);
}

/// What the command line says of the rotary axes; nothing where it leaves them.
std::optional<toolpath::SequencingSettings> sequencing_of(const Options& options,
                                                          const project::ProgramInput& program) {
    if (options.sequencing.empty() && !(options.largest_step_deg > 0.0)) {
        return std::nullopt;
    }
    toolpath::SequencingSettings settings;
    settings.goal = goal_named(options.sequencing).value_or(SequencingGoal::nearest);
    settings.largest_step = from_degrees(options.largest_step_deg);
    settings.feed = from_mm_per_min(program.feed_mm_per_min);
    settings.links_cut = program.link == project::LinkInput::on_surface;
    return settings;
}

void print_path(std::string_view name, const project::Workpiece& workpiece, const project::Evaluation& of) {
    const double step =
        toolpath::largest_rotary_step(workpiece.machine, of.toolpath, of.axes, toolpath::MoveKind::track);
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>13} {:>13}\n",
               name,
               of.toolpath.points.size(),
               fixed(of.closest.max, 4),
               fixed(of.closest.mean, 4),
               fixed(to_degrees(of.axes.rotary_travel), 1),
               fixed(to_degrees(step), 2));
}

/// The path of the chosen grid anew; prints it beside what it was.
void sequence(project::Plan& plan,
              const project::Project& project,
              const Options& options,
              const toolpath::SequencingSettings& settings,
              const std::stop_token& stop) {
    const auto before = plan.evaluation(project.grid.method);
    project::sequence_program(plan, project, settings, Progress({}, stop));
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>13} {:>13}\n",
               "sequence",
               "points",
               "max mm",
               "mean mm",
               "rotation deg",
               "in a cut deg");
    print_path("before", *plan.workpiece, *before);
    print_path(options.sequencing.empty() ? "nearest" : options.sequencing,
               *plan.workpiece,
               *plan.evaluation(project.grid.method));
}

int plan(const Options& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    make_folder(options.out);
    project::Plan plan = planned(opened, project::Scope::everything, interrupt.token());
    if (const auto settings = sequencing_of(options, opened.project.program)) {
        sequence(plan, opened.project, options, *settings, interrupt.token());
    }
    const PostedText text =
        posted(*plan.program, plan.workpiece->machine, options.post, opened.file.stem().string());
    constexpr render::PixelSize preview_size{1280, 800};
    const render::Picture preview = viewport::render_view(
        opened.project, plan, viewport::ViewKind::error, preview_size, render::Theme::dark);
    write_outputs(options.out,
                  {{"program." + text.format.extension, text.text.listing.text},
                   {"report.json", project::report_text(opened.project, plan)},
                   {"preview.png", render::to_png(preview)}},
                  opened.file);
    print_notes(text);
    print_summary(plan, opened.project);
    return 0;
}

} // namespace

void add_plan_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *app.add_subcommand("plan", "Make the program of a project, with a report and a picture");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for program, report.json and preview.png")
        ->required()
        ->type_name("DIR");
    std::vector<std::string> names;
    for (const Goal& goal : goals) {
        names.emplace_back(goal.name);
    }
    command.add_option("--sequencing", options->sequencing, "How the rotary axes are chosen along the path")
        ->check(CLI::IsMember(names));
    constexpr double least_step_deg = 0.01;
    command
        .add_option("--largest-step",
                    options->largest_step_deg,
                    "Add points where a rotary axis turns by more degrees in a move")
        ->check(CLI::Range(least_step_deg, 180.0));
    add_post_options(command, options->post);
    command.callback([&chosen, options] { chosen = [options] { return plan(*options); }; });
}

} // namespace millwright::app
