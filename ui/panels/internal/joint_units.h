// Joint positions as the panels show them: degrees for a revolute joint, mm for a prismatic one.
#pragma once

#include "core/base/units.h"
#include "core/kinematics/arm_model.h"

namespace millwright::panels {

[[nodiscard]] inline bool is_revolute(const kinematics::ArmJoint& joint) {
    return joint.kind == kinematics::JointKind::revolute;
}

[[nodiscard]] inline double in_joint_unit(const kinematics::ArmJoint& joint, double position) {
    return is_revolute(joint) ? to_degrees(position) : position;
}

[[nodiscard]] inline double from_joint_unit(const kinematics::ArmJoint& joint, double shown) {
    return is_revolute(joint) ? from_degrees(shown) : shown;
}

} // namespace millwright::panels
