#include "core/toolpath/actual_trajectory.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace millwright::toolpath {

geometry::ToolPose actual_pose(const kinematics::MachineModel& machine,
                               const kinematics::AxisPositions& a,
                               const kinematics::AxisPositions& b,
                               double t) {
    return kinematics::forward(machine, a + t * (b - a));
}

std::vector<geometry::ToolPose> actual_poses(const kinematics::MachineModel& machine,
                                             const kinematics::AxisPositions& a,
                                             const kinematics::AxisPositions& b,
                                             int count) {
    expects(count >= 2, "a trajectory is sampled at both ends");
    std::vector<geometry::ToolPose> poses;
    for (int k = 0; k < count; ++k) {
        poses.push_back(actual_pose(machine, a, b, static_cast<double>(k) / (count - 1)));
    }
    return poses;
}

namespace {

/// The first point of each track, and the number of all points.
std::vector<std::size_t> track_starts(const Toolpath& path) {
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        if (path.points[n].reached_by == MoveKind::start || path.points[n].reached_by == MoveKind::cross) {
            starts.push_back(n);
        }
    }
    starts.push_back(path.points.size());
    return starts;
}

/// Parameter along the tracks.
double parameter_along(const Toolpath& path, std::size_t point) {
    const Vec2& uv = path.points[point].origin.uv;
    return path.direction == grid::TrackDirection::along_v ? uv.y() : uv.x();
}

/// Of all tracks; 0 where they differ.
std::size_t points_per_track(const std::vector<std::size_t>& starts) {
    const std::size_t count = starts[1] - starts[0];
    for (std::size_t t = 1; t + 1 < starts.size(); ++t) {
        if (starts[t + 1] - starts[t] != count) {
            return 0;
        }
    }
    return count;
}

} // namespace

std::string why_no_produced_surface(const Toolpath& path) {
    if (path.tool.cutter) {
        return "The produced surface needs a point tool: a cutter also cuts beside its tip";
    }
    if (std::ranges::any_of(path.points,
                            [](const PathPoint& point) { return point.reached_by == MoveKind::over; })) {
        return "The produced surface needs a whole patch: this path lifts over parts that are not machined";
    }
    const std::vector<std::size_t> starts = track_starts(path);
    constexpr std::size_t fewest = 2; // tracks, and points of each
    if (starts.size() <= fewest || points_per_track(starts) < fewest) {
        return "The produced surface needs parallel tracks with equal numbers of points: this path has none";
    }
    return {};
}

std::optional<ProducedSurface> produced_surface(const kinematics::MachineModel& machine,
                                                const Toolpath& path,
                                                const AxisPath& axes,
                                                int steps) {
    expects(steps >= 1, "a move has a step");
    if (axes.positions.size() != path.points.size() || !why_no_produced_surface(path).empty()) {
        return std::nullopt;
    }
    const std::vector<std::size_t> starts = track_starts(path);
    const std::size_t tracks = starts.size() - 1, moves = starts[1] - starts[0] - 1;
    ProducedSurface found{
        .tracks = static_cast<int>(tracks), .places = static_cast<int>(moves) * steps + 1, .points = {}};
    for (std::size_t t = 0; t < tracks; ++t) {
        std::vector<Vec3> track;
        for (std::size_t move = starts[t]; move + 1 < starts[t + 1]; ++move) {
            for (int k = 0; k < steps; ++k) {
                const double at = static_cast<double>(k) / steps;
                track.push_back(actual_pose(machine, axes.positions[move], axes.positions[move + 1], at).tip);
            }
        }
        const kinematics::AxisPositions& last = axes.positions[starts[t + 1] - 1];
        track.push_back(actual_pose(machine, last, last, 0.0).tip);
        if (parameter_along(path, starts[t]) >
            parameter_along(path, starts[t + 1] - 1)) { // a zigzag comes back
            std::ranges::reverse(track);
        }
        std::ranges::move(track, std::back_inserter(found.points));
    }
    return found;
}

} // namespace millwright::toolpath
