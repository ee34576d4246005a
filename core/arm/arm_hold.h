// How an arm holds its tool at one place, coming from another: the branch that is nearest to where the joints
// are, or what keeps the arm from being there. Lengths mm, angles rad, in the base's frame.
#pragma once

#include "core/arm/arm_model.h"
#include "core/arm/arm_solver.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace millwright::arm {

enum class ArmTrouble : std::uint8_t {
    none,
    out_of_reach, ///< too far, too near, or not found
    joint_limit,  ///< only with a joint beyond its limits, or outside of the arm's zone
    tool_axis,    ///< not with the tool in this direction
    jump          ///< only with other joints than a moment before
};

struct ArmAim {
    ArmDemand demand = ArmDemand::tip_and_axis;
    /// By how much the tool axis may be turned where the arm cannot hold it: into the plane of an arm like
    /// the L-3, of others by the smallest angle that is found. Where the tip alone is demanded an arm like
    /// the L-3 turns it by any angle.
    double most_tilt = 1e-4;
};

/// What an arm is asked to keep along a path of its tool: with five joints or less the roll about the tool is
/// free.
[[nodiscard]] ArmAim aim_of(const ArmModel& arm, double most_tilt);

/// How far an arm is from holding its tool somewhere. What is not in the way is 0.
struct ArmShortfall {
    double tip = 0.0;    ///< mm from the nearest place that is found, the tool in its direction
    double axis = 0.0;   ///< rad between the direction of the tool and the nearest one that is found
    JointExcess joint{}; ///< beyond its limits; of a jump: how far it would go
};

struct ArmHold {
    JointPositions joints; ///< with trouble: those of before
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;   ///< a sentence about the trouble
    double tilt = 0.0; ///< by which the tool axis was turned
    ArmShortfall off{};
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

// How fast each joint has to move so that the tool goes straight somewhere: what a jog along an axis of the
// base or of the tool asks of the motors. Lengths mm, angles rad, times s.

struct ArmRates {
    std::optional<JointPositions> rates; ///< rad/s or mm/s; nothing where the arm cannot
    std::string why;                     ///< then a sentence
};

/// For the tip to move with `velocity` (base's frame, mm/s, not 0) and the tool leaning as it does: an arm of
/// the kind PlanarElbow keeps the lean in its plane and turns with it, any other keeps the tool's directions
/// where it has joints enough. By the inverse a moment ahead, so that limits, reach and places where the arm
/// is singular are refused before they are come to. Throws Defect if `velocity` is 0 or not finite.
[[nodiscard]] ArmRates tip_rates(const ArmModel& arm, const JointPositions& joints, const Vec3& velocity);

/// Where the joints are when the tip has gone straight by `way` (base's frame, mm), the tool leaning as for
/// tip_rates(), and by the same refusals. Without the drift of rates that are summed up.
[[nodiscard]] ArmHold moved_tip(const ArmModel& arm, const JointPositions& joints, const Vec3& way);

/// The tool at `tip`, leaning as at `joints`: carried around the base's axis by an arm of the kind
/// PlanarElbow.
[[nodiscard]] Frame carried_tool(const ArmModel& arm, const JointPositions& joints, const Vec3& tip);

} // namespace millwright::arm
