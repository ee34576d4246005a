// How an arm holds its tool at one place, coming from another: the branch that is nearest to where the joints
// are, or what keeps the arm from being there. Lengths mm, angles rad, in the base's frame.
#pragma once

#include "core/kinematics/arm_model.h"
#include "core/kinematics/arm_solver.h"

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::kinematics {

enum class ArmTrouble : std::uint8_t {
    none,
    out_of_reach, ///< too far, too near, or not found
    joint_limit,  ///< only with a joint beyond its limits, or outside of the arm's zone
    tool_axis,    ///< not with the tool in this direction
    jump          ///< only with other joints than a moment before
};

struct ArmAim {
    ArmDemand demand = ArmDemand::tip_and_axis;
    /// By how much the tool axis may be turned into the plane of an arm with five joints; it always is where
    /// the tip alone is demanded.
    double most_tilt = 1e-4;
};

struct ArmHold {
    JointPositions joints; ///< with trouble: those of before
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;   ///< a sentence about the trouble
    double tilt = 0.0; ///< by which the tool axis was turned
};

/// `goal`: the tool, whose z is the tool axis. Throws Defect if it is no rigid motion.
[[nodiscard]] ArmHold
hold_tool(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous);

/// Every way to hold it there that is known, nearest to `previous` first; for arms without a closed form
/// those that many starts find.
[[nodiscard]] std::vector<JointPositions>
all_holds(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous);

/// The largest difference of two positions in any joint: rad, or mm in units of the stretched arm.
[[nodiscard]] double joint_step(const ArmModel& arm, const JointPositions& a, const JointPositions& b);

} // namespace millwright::kinematics
