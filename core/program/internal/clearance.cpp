#include "core/program/internal/clearance.h"

#include "core/kinematics/forward.h"

#include <algorithm>
#include <cmath>

namespace millwright::program::internal {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using toolpath::Toolpath;

namespace {

/// The longest move: between two points of the path the surface is never farther than this from one of them.
double spacing(const Toolpath& path) {
    double longest = 0.0;
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        longest = std::max(longest, (path.points[n].pose.tip - path.points[n - 1].pose.tip).norm());
    }
    return longest;
}

AxisPositions between(const AxisPositions& a, const AxisPositions& b, double t) {
    return a + t * (b - a);
}

bool along_tool_axis(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    constexpr double parallel = 1e-6; // mm sideways; angles are compared by what they do to the axis
    const geometry::ToolPose from = kinematics::forward(machine, a);
    const geometry::ToolPose to = kinematics::forward(machine, b);
    const geometry::ToolPose middle = kinematics::forward(machine, between(a, b, 0.5));
    const auto off_axis = [&](const Vec3& tip) { return (tip - from.tip).cross(from.axis).norm(); };
    const double turned = std::max((to.axis - from.axis).norm(), (middle.axis - from.axis).norm());
    return turned < parallel && off_axis(to.tip) < parallel && off_axis(middle.tip) < parallel;
}

/// Length of the tip's way, from a coarse look at it.
double way_length(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    constexpr int looks = 16;
    double length = 0.0;
    Vec3 last = kinematics::forward(machine, a).tip;
    for (int k = 1; k <= looks; ++k) {
        const Vec3 tip = kinematics::forward(machine, between(a, b, static_cast<double>(k) / looks)).tip;
        length += (tip - last).norm();
        last = tip;
    }
    return length;
}

} // namespace

Clearance::Clearance(const Toolpath& toolpath, double height)
    : toolpath_(toolpath), height_(height), reach_(height + spacing(toolpath)) {
    for (std::size_t n = 0; n < toolpath.points.size(); ++n) {
        cells_[cell_of(toolpath.points[n].pose.tip)].push_back(static_cast<int>(n));
    }
}

Clearance::Cell Clearance::cell_of(const Vec3& point) const {
    constexpr double farthest = 1e9; // cells: beyond every machine, inside an int
    const auto index = [&](double x) {
        return static_cast<int>(std::clamp(std::floor(x / reach_), -farthest, farthest));
    };
    return {index(point.x()), index(point.y()), index(point.z())};
}

bool Clearance::clear(const Vec3& tip) const {
    const Cell middle = cell_of(tip);
    double nearest = reach_;
    double height = height_;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
        const Cell cell{
            middle[0] + neighbour % 3 - 1, middle[1] + neighbour / 3 % 3 - 1, middle[2] + neighbour / 9 - 1};
        const auto found = cells_.find(cell);
        if (found == cells_.end()) {
            continue;
        }
        for (const int n : found->second) {
            const geometry::ToolPose& pose = toolpath_.points[static_cast<std::size_t>(n)].pose;
            const Vec3 off = tip - pose.tip;
            if (off.norm() < nearest) {
                nearest = off.norm();
                height = off.dot(pose.axis);
            }
        }
    }
    return height >= height_;
}

bool Clearance::clear(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) const {
    if (along_tool_axis(machine, a, b)) {
        return true;
    }
    constexpr double steps_per_height = 2.0;
    constexpr double most = 10'000.0;
    const double wanted = way_length(machine, a, b) / height_ * steps_per_height;
    const int count = static_cast<int>(std::clamp(std::ceil(wanted), 8.0, most));
    for (int k = 0; k <= count; ++k) {
        const double t = static_cast<double>(k) / count;
        if (!clear(kinematics::forward(machine, between(a, b, t)).tip)) {
            return false;
        }
    }
    return true;
}

} // namespace millwright::program::internal
