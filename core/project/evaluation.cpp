#include "core/project/evaluation.h"

#include "core/base/error.h"
#include "core/project/sequenced_evaluation.h"
#include "core/toolpath/fixed_axis.h"
#include "core/toolpath/zigzag.h"

#include <memory>
#include <utility>

namespace millwright::project {

using toolpath::Distance;
using toolpath::MoveKind;

namespace {

toolpath::AxisPath axes_of(const Workpiece& workpiece, const toolpath::Toolpath& toolpath) {
    return workpiece.angle_mode == kinematics::AngleMode::consistent
               ? toolpath::sequence(workpiece.machine, toolpath)
               : toolpath::sequence_by_formulas(workpiece.machine, toolpath, workpiece.angle_mode);
}

/// What is measured of a path with its axis positions.
Evaluation measured(const Workpiece& workpiece,
                    GridOutcome outcome,
                    toolpath::SequencedPath path,
                    int samples,
                    const Progress& progress) {
    toolpath::ErrorField field = toolpath::error_field(
        workpiece.patch, workpiece.machine, path.toolpath, path.axes, samples, progress);
    const grid::ErrorSummary closest = toolpath::summary(field, Distance::closest, MoveKind::track);
    const grid::ErrorSummary param = toolpath::summary(field, Distance::param, MoveKind::track);
    const grid::ErrorSummary cross = toolpath::summary(field, Distance::closest, MoveKind::cross);
    const double gap = workpiece.error_model().track_gap(outcome.grid, workpiece.direction);
    const double length = toolpath::length(path.toolpath);
    return {std::move(outcome),
            std::move(path.toolpath),
            std::move(path.axes),
            std::move(field),
            closest,
            param,
            cross,
            gap,
            length};
}

toolpath::Toolpath zigzag_of(const Workpiece& workpiece, const grid::Grid& grid) {
    return toolpath::on_machine(
        workpiece.machine, toolpath::zigzag(workpiece.patch, grid, workpiece.direction, workpiece.flipped));
}

} // namespace

Evaluation evaluate(const Workpiece& workpiece, GridOutcome outcome, int samples, const Progress& progress) {
    progress.check();
    toolpath::Toolpath toolpath = zigzag_of(workpiece, outcome.grid);
    toolpath::AxisPath axes = axes_of(workpiece, toolpath);
    return measured(workpiece, std::move(outcome), {std::move(toolpath), std::move(axes)}, samples, progress);
}

Evaluation evaluate(const Workpiece& workpiece,
                    GridOutcome outcome,
                    const toolpath::SequencingSettings& sequencing,
                    int samples,
                    const Progress& progress) {
    progress.check();
    if (workpiece.angle_mode != kinematics::AngleMode::consistent) {
        throw Error("the faulty angle formulas leave no branch to choose",
                    {},
                    "take the consistent angles, or leave the sequencing");
    }
    constexpr double choosing = 0.5; // share of the work
    toolpath::SequencedPath path = toolpath::sequenced(workpiece.patch,
                                                       workpiece.machine,
                                                       zigzag_of(workpiece, outcome.grid),
                                                       sequencing,
                                                       progress.part(0.0, choosing));
    return measured(workpiece, std::move(outcome), std::move(path), samples, progress.part(choosing, 1.0));
}

void sequence_program(Plan& plan,
                      const Project& project,
                      const toolpath::SequencingSettings& sequencing,
                      const Progress& progress) {
    constexpr double measuring = 0.7; // share of the work
    Plan changed = plan;
    auto& chosen = changed.evaluation(project.grid.method);
    expects(chosen != nullptr, "the chosen grid is there before its path");
    chosen = std::make_shared<const Evaluation>(evaluate(
        *plan.workpiece, chosen->outcome, sequencing, report_samples, progress.part(0.0, measuring)));
    add_program(changed, project, progress.part(measuring, 1.0));
    plan = std::move(changed);
}

} // namespace millwright::project
