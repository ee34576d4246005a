// Joint positions as the panels show them: degrees for a revolute joint, mm for a prismatic one.
#pragma once

#include "core/arm/arm_model.h"
#include "core/base/units.h"

namespace millwright::panels {

[[nodiscard]] inline bool is_revolute(const arm::ArmJoint& joint) {
    return joint.kind == arm::JointKind::revolute;
}

[[nodiscard]] inline double in_joint_unit(const arm::ArmJoint& joint, double position) {
    return is_revolute(joint) ? to_degrees(position) : position;
}

[[nodiscard]] inline double from_joint_unit(const arm::ArmJoint& joint, double shown) {
    return is_revolute(joint) ? from_degrees(shown) : shown;
}

} // namespace millwright::panels
