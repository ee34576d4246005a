// The bodies of an arm of the Motoman L-3's kind, made from its lengths and linkages. What neither tells -
// thicknesses, the foot, the gripper - is ours. Lengths mm.
#pragma once

#include "core/arm/arm_bodies.h"
#include "core/geometry/glb.h"

#include <vector>

namespace millwright::arm {

struct MotomanSolids {
    std::vector<ArmPart> parts;               ///< what carries each, for the arm's file
    std::vector<geometry::PlacedBody> bodies; ///< the same order; at rest the upper arm stands upright
};

/// Throws Error for an arm of another kind, or one so small that the bodies would not fit.
[[nodiscard]] MotomanSolids motoman_solids(const ArmModel& arm, const ArmActuators& actuators);

} // namespace millwright::arm
