#include "core/project/evaluation.h"

#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <utility>

namespace millwright::project {

using toolpath::Distance;
using toolpath::MoveKind;

namespace {

toolpath::SequencedPath
path_of(const Workpiece& workpiece, const grid::Grid& grid, const Progress& progress) {
    toolpath::Toolpath path =
        toolpath::with_tool(workpiece.patch,
                            workpiece.machine,
                            workpiece.tool,
                            toolpath::zigzag(workpiece.patch, grid, workpiece.direction, workpiece.flipped));
    if (workpiece.angle_mode == kinematics::AngleMode::consistent) {
        return toolpath::sequenced(
            workpiece.patch, workpiece.machine, std::move(path), workpiece.sequencing, progress);
    }
    toolpath::AxisPath axes = toolpath::sequence_by_formulas(workpiece.machine, path, workpiece.angle_mode);
    return {std::move(path), std::move(axes)};
}

} // namespace

Evaluation evaluate(const Workpiece& workpiece, GridOutcome outcome, int samples, const Progress& progress) {
    progress.check();
    constexpr double sequencing = 0.3; // share of the work
    toolpath::SequencedPath path = path_of(workpiece, outcome.grid, progress.part(0.0, sequencing));
    toolpath::ErrorField field = toolpath::error_field(workpiece.patch,
                                                       workpiece.machine,
                                                       path.toolpath,
                                                       path.axes,
                                                       samples,
                                                       progress.part(sequencing, 1.0));
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

} // namespace millwright::project
