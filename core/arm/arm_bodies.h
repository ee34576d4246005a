// What an arm looks like: bodies from a glb file, each carried by a joint or by a part of a drive. Lengths
// mm, angles rad.
#pragma once

#include "core/arm/arm_actuators.h"
#include "core/arm/arm_model.h"
#include "core/geometry/glb.h"
#include "core/geometry/solid.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millwright::arm {

/// What a body moves with. Of a linear drive (2 or 3) the parts lie in the plane of the arm: the cylinder has
/// its origin where it turns, the rod where it pulls, and z of both points from the first to the second; y is
/// along the axis of joint 2. Of drive 3 the lever turns about the shoulder with the directions of link 3,
/// and the coupler has those of link 2, its origin being where the rod pulls.
enum class ArmCarrier : std::uint8_t { base, joint, cylinder, rod, lever, coupler };

struct ArmPart {
    std::string node; ///< of the glb file
    ArmCarrier carrier = ArmCarrier::base;
    int number = 0; ///< of a joint, from 0; of the drive of a cylinder or rod, 2 or 3
};

struct ArmBodies {
    std::filesystem::path file;
    std::vector<ArmPart> parts;
};

/// The bodies of all parts, in their order. Throws Error if the file cannot be read or lacks a node.
[[nodiscard]] std::vector<geometry::SolidBody> read_bodies(const ArmBodies& bodies);

/// Where the parts stand, in the base's frame and in their order. Throws Defect for a part of a drive of an
/// arm without drives, and for joints that there are not.
[[nodiscard]] std::vector<Frame> base_T_parts(const ArmModel& arm,
                                              const std::optional<ArmActuators>& actuators,
                                              const std::vector<ArmPart>& parts,
                                              const JointPositions& positions);

// The bodies of an arm of the Motoman L-3's kind, made from its lengths and linkages. What neither tells -
// thicknesses, the foot, the gripper - is ours. Lengths mm.

struct MotomanSolids {
    std::vector<ArmPart> parts;               ///< what carries each, for the arm's file
    std::vector<geometry::PlacedBody> bodies; ///< the same order; at rest the upper arm stands upright
};

/// Throws Error for an arm of another kind, or one so small that the bodies would not fit.
[[nodiscard]] MotomanSolids motoman_solids(const ArmModel& arm, const ArmActuators& actuators);

} // namespace millwright::arm
