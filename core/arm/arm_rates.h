// How fast each joint has to move so that the tool goes straight somewhere: what a jog along an axis of the
// base or of the tool asks of the motors. Lengths mm, angles rad, times s.
#pragma once

#include "core/arm/arm_hold.h"
#include "core/arm/arm_model.h"

#include <optional>
#include <string>

namespace millwright::arm {

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
