#include "core/project/evaluation.h"

#include "core/toolpath/fixed_axis.h"
#include "core/toolpath/zigzag.h"

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

} // namespace

Evaluation evaluate(const Workpiece& workpiece, GridOutcome outcome, int samples, const Progress& progress) {
    progress.check();
    toolpath::Toolpath toolpath = toolpath::on_machine(
        workpiece.machine,
        toolpath::zigzag(workpiece.patch, outcome.grid, workpiece.direction, workpiece.flipped));
    toolpath::AxisPath axes = axes_of(workpiece, toolpath);
    toolpath::ErrorField field =
        toolpath::error_field(workpiece.patch, workpiece.machine, toolpath, axes, samples, progress);
    const grid::ErrorSummary closest = toolpath::summary(field, Distance::closest, MoveKind::track);
    const grid::ErrorSummary param = toolpath::summary(field, Distance::param, MoveKind::track);
    const grid::ErrorSummary cross = toolpath::summary(field, Distance::closest, MoveKind::cross);
    const double gap = workpiece.error_model().track_gap(outcome.grid, workpiece.direction);
    const double length = toolpath::length(toolpath);
    return {std::move(outcome),
            std::move(toolpath),
            std::move(axes),
            std::move(field),
            closest,
            param,
            cross,
            gap,
            length};
}

} // namespace millwright::project
