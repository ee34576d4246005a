#include "core/toolpath/sequencing.h"

#include "core/base/error.h"
#include "core/kinematics/inverse.h"

#include <fmt/format.h>

namespace millwright::toolpath {

void refuse_point(std::size_t n, const PathPoint& point, const std::string& why) {
    throw Error(fmt::format("path point {} (node {},{}, tip {:.3f} {:.3f} {:.3f}) cannot be reached: {}",
                            n,
                            point.origin.i,
                            point.origin.j,
                            point.pose.tip.x(),
                            point.pose.tip.y(),
                            point.pose.tip.z(),
                            why),
                {},
                "move the part on the table, or choose another machine");
}

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;

AxisPositions
position_at(const MachineModel& machine, const Toolpath& path, std::size_t n, const AxisPositions& previous) {
    const kinematics::InverseSolution solution = kinematics::inverse(machine, path.points[n].pose, previous);
    if (solution.branches.empty()) {
        refuse_point(n, path.points[n], solution.why);
    }
    return kinematics::nearest_branch(machine, solution.branches, previous);
}

/// What a track's first point counts as its past: the point before, or, on a pole, the first one off the
/// pole.
AxisPositions past_of_start(const MachineModel& machine,
                            const Toolpath& path,
                            std::size_t n,
                            const AxisPositions& previous) {
    std::size_t next = n;
    while (next < path.points.size() && kinematics::at_pole(machine, path.points[next].pose.axis)) {
        ++next;
    }
    const bool on_pole = next > n;
    return on_pole && next < path.points.size() ? position_at(machine, path, next, previous) : previous;
}

double total_travel(const MachineModel& machine, const std::vector<AxisPositions>& positions) {
    double travel = 0.0;
    for (std::size_t n = 1; n < positions.size(); ++n) {
        travel += kinematics::rotary_travel(machine, positions[n - 1], positions[n]);
    }
    return travel;
}

} // namespace

AxisPath sequence(const MachineModel& machine, const Toolpath& toolpath) {
    AxisPath path;
    AxisPositions previous = AxisPositions::Zero(machine.axis_count());
    for (std::size_t n = 0; n < toolpath.points.size(); ++n) {
        if (toolpath.points[n].reached_by != MoveKind::track) {
            previous = past_of_start(machine, toolpath, n, previous);
        }
        previous = position_at(machine, toolpath, n, previous);
        path.positions.push_back(previous);
    }
    path.rotary_travel = total_travel(machine, path.positions);
    return path;
}

AxisPath
sequence_by_formulas(const MachineModel& machine, const Toolpath& toolpath, kinematics::AngleMode mode) {
    if (machine.description().angle_formulas != kinematics::AngleFormulas::rotary_tilt) {
        throw Error(
            fmt::format("machine '{}' does not support the angle formulas of the thesis", machine.name()));
    }
    const int A = machine.axis_index('A');
    const int B = machine.axis_index('B');
    expects(A >= 0 && B >= 0, "a machine with the rotary-tilt formulas has axes A and B");
    AxisPath path;
    for (const PathPoint& point : toolpath.points) {
        const auto angles = kinematics::rotary_tilt_angles(mode, point.pose.axis);
        AxisPositions q = AxisPositions::Zero(machine.axis_count());
        q[A] = angles.A;
        q[B] = angles.B;
        path.positions.push_back(kinematics::with_tip_at(machine, q, point.pose.tip));
    }
    path.rotary_travel = total_travel(machine, path.positions);
    return path;
}

} // namespace millwright::toolpath
