#include "core/plan/plan_program.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/motion/planner.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/plan.h"
#include "core/plan/planned_time.h"
#include "core/plan/strategy_path.h"
#include "core/posts/release.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/tool_settings.h"
#include "core/project/version.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

namespace millwright::plan {

namespace {

using project::GridMethod;

/// What produced the program, written on its top.
std::vector<program::HeaderLine>
header_of(const project::Project& project, const Plan& plan, const Evaluation& chosen) {
    const grid::Grid& grid = chosen.outcome.grid;
    const bool uniform = keeps_grid(chosen, *plan.grid(GridMethod::uniform).evaluation); // whatever was tried
    const std::string_view method = row_of(uniform ? GridMethod::uniform : program_grid(project)).label;
    const bool has_nodes = follows_nodes(project.toolpath.strategy);
    std::vector<program::HeaderLine> lines{
        {"made by", fmt::format("Millwright {}", project::version())},
        {"project", project.name},
        {"machine", plan.cutting_setup->machine.name()},
        {"tool", project::tool_text(project.tool)},
        {"tool length", project::tool_length_text(project.tool, plan.cutting_setup->machine)},
        {has_nodes ? "grid" : "path",
         has_nodes ? fmt::format("{} x {}, {}", grid.nu(), grid.nv(), method) : strategy_text(project)},
        {"distance from the surface",
         fmt::format("at most {} mm, {} mm on average inside the tracks",
                     fixed(chosen.closest.max, 4),
                     fixed(chosen.closest.mean, 4))},
        {"note", checked_face_text(project)},
        {plan.cutting_setup->tool.lean.upright() ? "tool axis from the normal"
                                                 : "tool axis from where it should be",
         fmt::format("at most {} deg", fixed(to_degrees(chosen.closest.axis_max), 3))}};
    if (has_nodes && has_own_path(project)) {
        lines.insert(lines.begin() + 6, {"path", strategy_text(project)});
    }
    return lines;
}

} // namespace

program::ProgramSettings program_settings(const project::ProgramInput& input) {
    program::ProgramSettings settings;
    settings.cutting_feed = from_mm_per_min(input.feed_mm_per_min);
    settings.plunge_feed = from_mm_per_min(input.plunge_mm_per_min);
    settings.link =
        input.link == project::LinkInput::lifted ? program::LinkKind::lifted : program::LinkKind::on_surface;
    settings.link_clearance = input.link_clearance_mm;
    settings.approach_clearance = input.approach_clearance_mm;
    settings.spindle_rpm = input.spindle_rpm;
    return settings;
}

void add_program(Plan& plan, const project::Project& project, const Progress& progress) {
    const Evaluation& chosen = *plan.program_path(project);
    const program::ProgramSettings settings = program_settings(project.program);
    const kinematics::MachineModel& machine = plan.cutting_setup->machine;
    progress.report(0.0, "Writing the program");
    progress.check();
    program::PostResult posted = program::post(
        machine, chosen.toolpath, chosen.axes, settings, header_of(project, plan, chosen), progress);
    posted.program.tool = project::program_tool(project.tool, machine);
    if (const auto cutter = project::program_cutter(project.tool)) {
        posted.program.cutters.push_back(*cutter);
    }
    progress.check();
    posts::ReleasedText released = posts::release(posted.program,
                                                  machine,
                                                  posts::PostFormat{},
                                                  {.text = {.name = posts::text_name(project.name),
                                                            .line_numbers = settings.line_numbers,
                                                            .path_tolerance = settings.path_tolerance}});
    progress.report(0.4, "Planning the motion");
    auto trajectory = std::make_shared<const motion::Trajectory>(
        motion::plan(released.program, machine, motion::PlannerSettings{}, progress.part(0.4, 1.0)));
    plan.program = std::make_shared<const program::Program>(std::move(released.program));
    plan.program_notes = posted.notes;
    plan.listing = std::make_shared<const program::Listing>(std::move(released.listing));
    plan.trajectory = std::move(trajectory);
    plan.program_time(project) = plan.trajectory->duration();
    progress.report(1.0);
}

std::optional<double> estimated_time(const Evaluation& evaluation,
                                     const kinematics::MachineModel& machine,
                                     const project::ProgramInput& input,
                                     const Progress& progress) {
    return planned_time(evaluation.toolpath, evaluation.axes, machine, input, progress);
}

void add_unsequenced(Plan& plan, const project::Project& project, const Progress& progress) {
    const auto& chosen = plan.program_path(project);
    plan.unsequenced = nullptr;
    plan.unsequenced_time.reset();
    if (project.sequencing == project::SequencingInput{} ||
        plan.cutting_setup->machine.rotary_axes().empty() || !chosen) {
        return;
    }
    CuttingSetup plain = *plan.cutting_setup;
    plain.sequencing = {};
    Evaluation before = evaluate(
        plain, chosen->outcome, strategy_settings(project), report_sampling, progress.part(0.0, 0.9));
    plan.unsequenced_time = estimated_time(before, plain.machine, project.program, progress.part(0.9, 1.0));
    plan.unsequenced = std::make_shared<const Evaluation>(std::move(before));
}

} // namespace millwright::plan
