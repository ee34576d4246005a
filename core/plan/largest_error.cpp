#include "core/plan/largest_error.h"

#include "core/toolpath/actual_trajectory.h"

#include <algorithm>

namespace millwright::plan {

std::optional<geometry::DistanceBounds> largest_error_bounds(const CuttingSetup& cutting_setup,
                                                             const Evaluation& evaluation) {
    if (cutting_setup.tool.cutter) {
        return std::nullopt;
    }
    const std::vector<toolpath::MoveDeviation>& moves = evaluation.field.moves;
    std::optional<std::size_t> worst;
    for (std::size_t n = 0; n < moves.size(); ++n) {
        if (moves[n].kind == toolpath::MoveKind::track &&
            (!worst || moves[n].closest > moves[*worst].closest)) {
            worst = n;
        }
    }
    if (!worst) {
        return std::nullopt;
    }
    const Vec3 tip = toolpath::actual_pose(cutting_setup.machine,
                                           evaluation.axes.positions[*worst],
                                           evaluation.axes.positions[*worst + 1],
                                           moves[*worst].worst_at)
                         .tip;
    const double found = moves[*worst].closest;
    const double tolerance = std::max(1e-3 * found, 1e-4);
    return geometry::DistanceBounds{
        geometry::distance_bounds(cutting_setup.patch, tip, found, tolerance).at_least, found};
}

} // namespace millwright::plan
