#include "core/toolpath/error_field.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/body_clearance.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace millwright::toolpath {

namespace {

/// All that the moves of a path are judged by.
struct Cut {
    const geometry::BezierPatch& patch;
    const geometry::ClosestPointSearch& search;
    const kinematics::MachineModel& machine;
    const Toolpath& path;
};

bool is_flipped(const Cut& cut, const PathPoint& point) {
    const Vec2& uv = point.origin.uv;
    return cut.patch.unit_normal(uv.x(), uv.y()).value_or(point.normal).dot(point.normal) < 0.0;
}

/// The normal at `uv` on the side of the tool; `otherwise` where there is none.
Vec3 normal_at(const Cut& cut, const Vec2& uv, bool flipped, const Vec3& otherwise) {
    const Vec3 normal =
        cut.patch.unit_normal(uv.x(), uv.y()).value_or(flipped ? Vec3(-otherwise) : otherwise);
    return flipped ? Vec3(-normal) : normal;
}

/// The surface point that the tool is nearest to, and how far it is from cutting just that.
struct Off {
    Vec2 parameters = Vec2::Zero();
    double distance = 0.0;
};

Off off_surface(const Cut& cut, const geometry::ToolPose& pose, const Vec2& uv) {
    if (cut.path.tool.cutter) {
        const BodyClearance found = clearance_near(cut.patch, *cut.path.tool.cutter, pose, uv);
        return {found.parameters, std::abs(found.distance)};
    }
    const geometry::ClosestPoint nearest = cut.search.closest(pose.tip, uv);
    return {nearest.parameters, nearest.distance};
}

MoveDeviation deviation(const Cut& cut,
                        std::size_t move,
                        const kinematics::AxisPositions& a,
                        const kinematics::AxisPositions& b,
                        int samples) {
    const PathPoint& from = cut.path.points[move];
    const PathPoint& to = cut.path.points[move + 1];
    const Vec2 heading_from = heading_at(cut.path, move);
    const Vec2 heading_to = heading_at(cut.path, move + 1);
    const bool flipped = is_flipped(cut, from);
    MoveDeviation worst;
    worst.kind = to.reached_by;
    worst.length = (to.pose.tip - from.pose.tip).norm();
    for (int k = 1; k <= samples; ++k) {
        const double t = static_cast<double>(k) / (samples + 1);
        const geometry::ToolPose actual = actual_pose(cut.machine, a, b, t);
        const Vec2 uv = (1.0 - t) * from.origin.uv + t * to.origin.uv;
        const Vec2 heading = (1.0 - t) * heading_from + t * heading_to;
        const geometry::ToolPose intended = intended_pose(
            cut.patch, cut.machine, cut.path, uv, heading, normal_at(cut, uv, flipped, actual.axis));
        worst.param = std::max(worst.param, (intended.tip - actual.tip).norm());
        const Off off = off_surface(cut, actual, uv);
        if (off.distance > worst.closest) {
            worst.closest = off.distance;
            worst.worst_at = t;
        }
        const Vec3 normal = normal_at(cut, off.parameters, flipped, actual.axis);
        const Vec3 axis = intended_axis(cut.patch, cut.path, off.parameters, heading, normal);
        worst.axis = std::max(worst.axis, angle_between(axis, actual.axis));
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
    const Cut cut{patch, search, machine, toolpath};
    ErrorField field;
    const auto moves = std::max<std::ptrdiff_t>(0, std::ssize(toolpath.points) - 1);
    field.moves.resize(static_cast<std::size_t>(moves));
    constexpr std::ptrdiff_t chunk = 16, reports = 100;
    const std::ptrdiff_t step = std::max<std::ptrdiff_t>(1, moves / reports);
    std::atomic<std::ptrdiff_t> done = 0;
    parallel_for(moves, chunk, [&](std::ptrdiff_t move) {
        progress.check();
        const auto n = static_cast<std::size_t>(move);
        field.moves[n] = deviation(cut, n, axes.positions[n], axes.positions[n + 1], samples);
        if (const std::ptrdiff_t so_far = ++done; so_far % step == 0) {
            progress.report(static_cast<double>(so_far) / static_cast<double>(moves));
        }
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
