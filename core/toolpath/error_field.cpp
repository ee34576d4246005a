#include "core/toolpath/error_field.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/toolpath/actual_trajectory.h"

#include <algorithm>

namespace millwright::toolpath {

namespace {

MoveDeviation deviation(const geometry::BezierPatch& patch,
                        const geometry::ClosestPointSearch& search,
                        const kinematics::MachineModel& machine,
                        const PathPoint& from,
                        const PathPoint& to,
                        const kinematics::AxisPositions& a,
                        const kinematics::AxisPositions& b,
                        int samples) {
    MoveDeviation worst;
    worst.kind = to.reached_by;
    worst.length = (to.pose.tip - from.pose.tip).norm();
    const bool flipped = patch.unit_normal(from.origin.uv.x(), from.origin.uv.y())
                             .value_or(from.pose.axis)
                             .dot(from.pose.axis) < 0.0;
    for (int k = 1; k <= samples; ++k) {
        const double t = static_cast<double>(k) / (samples + 1);
        const geometry::ToolPose actual = actual_pose(machine, a, b, t);
        const Vec2 uv = (1.0 - t) * from.origin.uv + t * to.origin.uv;
        worst.param = std::max(worst.param, (patch.position(uv.x(), uv.y()) - actual.tip).norm());
        const geometry::ClosestPoint nearest = search.closest(actual.tip, uv);
        if (nearest.distance > worst.closest) {
            worst.closest = nearest.distance;
            worst.worst_at = t;
        }
        const Vec3 normal =
            patch.unit_normal(nearest.parameters.x(), nearest.parameters.y()).value_or(actual.axis);
        worst.axis = std::max(worst.axis, angle_between(flipped ? Vec3(-normal) : normal, actual.axis));
    }
    return worst;
}

} // namespace

ErrorField error_field(const geometry::BezierPatch& patch,
                       const kinematics::MachineModel& machine,
                       const Toolpath& toolpath,
                       const AxisPath& axes,
                       int samples,
                       const Progress& progress) {
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their path");
    expects(samples >= 1, "a move is sampled at least once");
    const geometry::ClosestPointSearch search(patch);
    ErrorField field;
    const auto moves = std::max<std::ptrdiff_t>(0, std::ssize(toolpath.points) - 1);
    field.moves.resize(static_cast<std::size_t>(moves));
    constexpr std::ptrdiff_t chunk = 16;
    parallel_for(moves, chunk, [&](std::ptrdiff_t move) {
        progress.check();
        const auto n = static_cast<std::size_t>(move);
        field.moves[n] = deviation(patch,
                                   search,
                                   machine,
                                   toolpath.points[n],
                                   toolpath.points[n + 1],
                                   axes.positions[n],
                                   axes.positions[n + 1],
                                   samples);
    });
    progress.report(1.0);
    return field;
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
