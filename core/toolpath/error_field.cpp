#include "core/toolpath/error_field.h"

#include "core/toolpath/tool_error.h"

namespace millwright::toolpath {

ErrorField error_field(const geometry::BezierPatch& patch,
                       const kinematics::MachineModel& machine,
                       const Toolpath& toolpath,
                       const AxisPath& axes,
                       int samples,
                       const Progress& progress) {
    return tool_error(patch, machine, Tool{}, toolpath, axes, samples, progress);
}

grid::ErrorSummary summary(const ErrorField& field, Distance distance, MoveKind kind) {
    std::vector<grid::MoveError> moves;
    for (const MoveDeviation& move : field.moves) {
        if (move.kind == kind) {
            moves.push_back(
                {distance == Distance::closest ? move.closest : move.param, move.axis, move.length});
        }
    }
    return moves.empty() ? grid::ErrorSummary{} : grid::summary(moves);
}

} // namespace millwright::toolpath
