#include "core/toolpath/actual_trajectory.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"

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

} // namespace millwright::toolpath
