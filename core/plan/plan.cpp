#include "core/plan/plan.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/geometry/self_crossing.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/rotary_tilt_machine.h"
#include "core/motion/planner.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/plan/left_out.h"
#include "core/plan/planned_time.h"
#include "core/plan/strategy_path.h"
#include "core/posts/release.h"
#include "core/project/assets.h"
#include "core/project/settings.h"
#include "core/project/surface.h"
#include "core/project/tool_settings.h"
#include "core/project/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

namespace millwright::plan {

namespace {

/// What produced the program, written on its top.
std::vector<program::HeaderLine>
header_of(const project::Project& project, const Plan& plan, const Evaluation& chosen) {
    const grid::Grid& grid = chosen.outcome.grid;
    const bool uniform = keeps_grid(chosen, *plan.uniform); // whatever was tried
    const std::string_view method =
        project::row_of(project::grid_methods(),
                        uniform ? project::GridMethod::uniform : program_grid(project))
            .label;
    const bool has_nodes = follows_nodes(project.toolpath.strategy);
    std::vector<program::HeaderLine> lines{
        {"made by", fmt::format("Millwright {}", project::version())},
        {"project", project.name},
        {"machine", plan.workpiece->machine.name()},
        {"tool", project::tool_text(project.tool)},
        {"tool length", project::tool_length_text(project.tool, plan.workpiece->machine)},
        {has_nodes ? "grid" : "path",
         has_nodes ? fmt::format("{} x {}, {}", grid.nu(), grid.nv(), method) : strategy_text(project)},
        {"distance from the surface",
         fmt::format("at most {} mm, {} mm on average inside the tracks",
                     fixed(chosen.closest.max, 4),
                     fixed(chosen.closest.mean, 4))},
        {"checked", checked_face_text(project)},
        {plan.workpiece->tool.lean.upright() ? "tool axis from the normal"
                                             : "tool axis from where it should be",
         fmt::format("at most {} deg", fixed(to_degrees(chosen.closest.axis_max), 3))}};
    if (has_nodes && has_own_path(project)) {
        lines.insert(lines.begin() + 6, {"path", strategy_text(project)});
    }
    return lines;
}

/// By GridMethod.
constexpr std::array evaluations{
    &Plan::uniform, &Plan::redistributed, &Plan::elliptic, &Plan::harmonic, &Plan::optimised, &Plan::chain};

void refuse_faults(const project::Project& project) {
    const std::vector<std::string> faults = project::faults_of(project);
    if (!faults.empty()) {
        throw Error(faults.front());
    }
}

} // namespace

const std::shared_ptr<const Evaluation>& Plan::evaluation(project::GridMethod method) const {
    return this->*evaluations.at(static_cast<std::size_t>(method));
}

std::shared_ptr<const Evaluation>& Plan::evaluation(project::GridMethod method) {
    return this->*evaluations.at(static_cast<std::size_t>(method));
}

const std::shared_ptr<const Evaluation>& Plan::program_path(const project::Project& project) const {
    return has_own_path(project) ? path : evaluation(program_grid(project));
}

std::optional<double>& Plan::program_time(const project::Project& project) {
    return has_own_path(project) ? path_time : estimated_time(program_grid(project));
}

std::shared_ptr<const CutStudy> Plan::cut_of(const project::Project& project,
                                             const Evaluation* evaluation) const {
    if (evaluation == nullptr || evaluation == program_path(project).get()) {
        return evaluation == nullptr ? nullptr : cut;
    }
    for (const project::GridMethod method : project::every_grid_method) {
        if (this->evaluation(method).get() == evaluation) {
            return compared_cuts[static_cast<std::size_t>(method)];
        }
    }
    return nullptr;
}

namespace {

/// What was trimmed away may cross what it likes.
void refuse_crossing(const geometry::BezierPatch& patch, const geometry::Trim& trim) {
    if (!trim.everything()) {
        return;
    }
    if (const auto crossing = geometry::self_crossing(patch)) {
        throw Error(
            fmt::format("the surface touches itself or passes through itself: near u {:.2f}, v {:.2f} it "
                        "comes to where it is near u {:.2f}, v {:.2f}",
                        crossing->first.x(),
                        crossing->first.y(),
                        crossing->second.x(),
                        crossing->second.y()),
            {},
            "a tool cuts from one side: move the control points apart, or split the surface");
    }
}

/// The machine with the constants of the project. Throws Error with the field where it has no such constants.
kinematics::MachineModel with_tool_set(const kinematics::MachineModel& machine,
                                       const project::ToolSetInput& set) {
    const Vec3 part = machine.description().workpiece_offset;
    try {
        return kinematics::with_rotary_tilt(machine,
                                            {.a = part.x(),
                                             .b = part.y(),
                                             .c = part.z(),
                                             .e = set.e,
                                             .AB = set.AB,
                                             .B4 = set.B4,
                                             .OF = set.OF});
    } catch (const Error& fault) {
        throw Error("machine/tool_set: " + fault.diagnostic().message,
                    {},
                    "leave tool_set out, or choose a machine of the thesis");
    }
}

} // namespace

Workpiece workpiece_of(const project::Project& project, const Folders& folders) {
    const auto number = static_cast<std::size_t>(project.surface.machined_patch);
    geometry::BezierPatch patch(project.surface.patches.at(number));
    refuse_crossing(patch, project.surface.trim(project.surface.machined_patch));
    kinematics::MachineModel machine =
        kinematics::read_machine(project::machine_path(project, folders.project, folders.assets));
    if (const auto& set = project.machine.tool_set) {
        machine = with_tool_set(machine, *set);
    }
    machine = project::machine_with(project.tool, machine);
    if (project.machine.workpiece_offset) {
        machine = machine.with_workpiece_offset(*project.machine.workpiece_offset);
    }
    return {std::move(patch),
            std::move(machine),
            project.grid.direction,
            project.surface.flipped,
            project.machine.angle_mode,
            project::tool_of(project.tool),
            sequencing_settings(project),
            timing(project),
            project.surface.trim(project.surface.machined_patch)};
}

project::ProgramInput timing(const project::Project& project) {
    return project.sequencing.goal == toolpath::SequencingGoal::time ? project.program
                                                                     : project::ProgramInput{};
}

toolpath::SequencingSettings sequencing_settings(const project::Project& project) {
    using toolpath::SequencingGoal;
    toolpath::SequencingSettings settings;
    settings.goal = project.sequencing.goal;
    settings.largest_step = from_degrees(project.sequencing.largest_step_deg);
    if (settings.goal == SequencingGoal::time) {
        settings.feed = from_mm_per_min(project.program.feed_mm_per_min);
    }
    settings.links_cut =
        settings.goal == SequencingGoal::error && project.program.link == project::LinkInput::on_surface;
    return settings;
}

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
    const kinematics::MachineModel& machine = plan.workpiece->machine;
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
    if (project.sequencing == project::SequencingInput{} || plan.workpiece->machine.rotary_axes().empty() ||
        !chosen) {
        return;
    }
    Workpiece plain = *plan.workpiece;
    plain.sequencing = {};
    Evaluation before = evaluate(
        plain, chosen->outcome, strategy_settings(project), report_sampling, progress.part(0.0, 0.9));
    plan.unsequenced_time = estimated_time(before, plain.machine, project.program, progress.part(0.9, 1.0));
    plan.unsequenced = std::make_shared<const Evaluation>(std::move(before));
}

void add_estimated_times(Plan& plan, const project::Project& project, const Progress& progress) {
    double from = 0.0;
    for (const project::GridMethod method : project::every_grid_method) {
        const double to = from + 1.0 / static_cast<double>(project::every_grid_method.size());
        const auto& evaluation = plan.evaluation(method);
        if (evaluation && !plan.estimated_time(method)) {
            plan.estimated_time(method) = estimated_time(
                *evaluation, plan.workpiece->machine, project.program, progress.part(from, to));
        }
        from = to;
    }
}

std::vector<std::string> memory_sentences(const project::Project& project, Scope scope) {
    constexpr std::int64_t many_nodes = 10'000;
    const std::int64_t nodes = std::int64_t{project.grid.nu} * project.grid.nv;
    std::vector<std::string> sentences;
    if (nodes < many_nodes) {
        return sentences;
    }
    std::set<project::GridMethod> methods{program_grid(project)};
    if (scope == Scope::everything) {
        methods.insert(project::compared_methods.begin(), project::compared_methods.end());
    }
    for (const project::GridMethod method : methods) {
        const std::string sentence =
            is_left_out(project, method) ? std::string() : memory_sentence(method, project.grid);
        if (!sentence.empty()) {
            sentences.push_back(with_full_stop(sentence));
        }
    }
    if (nodes > most_compared_nodes && scope == Scope::everything) {
        constexpr double gigabytes_a_point = 3.9e-6; // `plan` of the dome with a million, nothing compared
        sentences.push_back(fmt::format("Path, program and motion of {} points take about {:.1f} GB.",
                                        nodes,
                                        gigabytes_a_point * static_cast<double>(nodes)));
    }
    return sentences;
}

Plan make_plan(const project::Project& project,
               const Folders& folders,
               const Progress& progress,
               Scope scope) {
    refuse_faults(project);
    expect_memory(program_grid(project), project.grid);
    Plan plan;
    plan.surface = std::make_shared<const geometry::Surface>(project::surface_of(project.surface));
    plan.trims = std::make_shared<const std::vector<geometry::Trim>>(project.surface.trims);
    plan.workpiece = std::make_shared<const Workpiece>(workpiece_of(project, folders));
    const Workpiece& workpiece = *plan.workpiece;
    plan.singular_points = toolpath::singular_points(workpiece.patch, workpiece.machine);

    progress.report(0.0, title_of_making(project::GridMethod::uniform));
    plan.uniform = std::make_shared<const Evaluation>(
        evaluate(workpiece, uniform_outcome(project.grid), report_sampling, progress.part(0.0, 0.1)));
    const auto make = [&](project::GridMethod method, const Progress& part) {
        part.report(0.0, title_of_making(method));
        if (method == project::GridMethod::elliptic && scope == Scope::everything) {
            plan.weight =
                std::make_shared<const WeightMap>(weight_map(project.grid, workpiece, part.part(0.0, 0.0)));
        }
        plan.evaluation(method) = std::make_shared<const Evaluation>(
            improved_evaluation({method, project.grid, workpiece}, *plan.uniform, part));
    };
    const auto improve = [&](project::GridMethod method, const Progress& part) {
        if (method == program_grid(project)) {
            make(method, part);
        } else if (scope == Scope::everything && std::ranges::count(project::compared_methods, method) > 0 &&
                   !is_left_out(project, method)) {
            try {
                make(method, part);
            } catch (const Error& fault) { // its own: the program needs it not
                plan.failure(method) = fault.diagnostic();
            }
        }
    };
    improve(project::GridMethod::redistribution, progress.part(0.1, 0.12));
    improve(project::GridMethod::elliptic, progress.part(0.12, 0.25));
    improve(project::GridMethod::harmonic, progress.part(0.25, 0.4));
    improve(project::GridMethod::tracks, progress.part(0.4, 0.5));
    improve(project::GridMethod::chain, progress.part(0.5, 0.85));
    if (has_own_path(project)) {
        progress.part(0.85, 0.9).report(0.0, title_of_path);
        plan.path =
            std::make_shared<const Evaluation>(path_evaluation(project,
                                                               workpiece,
                                                               *plan.evaluation(program_grid(project)),
                                                               *plan.uniform,
                                                               report_sampling,
                                                               progress.part(0.85, 0.9)));
    }
    add_program(plan, project, progress.part(0.9, 0.92));
    add_estimated_times(plan, project, progress.part(0.92, 0.94));
    add_unsequenced(plan, project, progress.part(0.94, 0.95));
    if (scope == Scope::everything) {
        add_cut_study(plan, project, progress.part(0.95, 1.0));
    }
    return plan;
}

} // namespace millwright::plan
