// What an arm has to keep beside the limits of each joint: a box for its tip, and the limits of drives that
// depend on one another. Lengths mm, angles rad, in the base's frame.
#pragma once

#include "core/arm/arm_actuators.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace millwright::arm {

struct ArmZone {
    Vec3 least = Vec3::Constant(-std::numeric_limits<double>::infinity()); ///< of the tip
    Vec3 most = Vec3::Constant(std::numeric_limits<double>::infinity());
    std::optional<ArmActuators> drives; ///< whose limits, and whose triangles, are kept; none: no drive's
};

struct ZoneBreach {
    int limit = 0;       ///< the same number is the same limit
    double depth = 0.0;  ///< beyond it: mm, or degrees of a drive that turns
    std::string why;     ///< a sentence
    bool of_tip = false; ///< a side of the workspace, so that `depth` is the tip's distance from it
};

/// The limits of the drives that are broken there: triangles that do not close, A3 against A2, the window of
/// A5.
[[nodiscard]] std::vector<ZoneBreach> drive_breaches(const ArmActuators& drives,
                                                     const JointPositions& joints);

/// All that is broken there; empty for an arm without a zone. Joint limits are not looked at.
[[nodiscard]] std::vector<ZoneBreach> zone_breaches(const ArmModel& arm, const JointPositions& joints);

/// A sentence for each limit of a joint and side of the workspace that is broken there; then, where
/// `actuators` are given, for each limit of them, watched or not.
[[nodiscard]] std::vector<std::string> broken_limits(const ArmModel& arm,
                                                     const std::optional<ArmActuators>& actuators,
                                                     const JointPositions& joints);

/// Why the arm must not go there: a limit that is broken by more than `slack` (mm or degrees), and by more
/// than where it comes from, so that it may always go back; nothing if it may.
[[nodiscard]] std::optional<ZoneBreach>
zone_exit(const ArmModel& arm, const JointPositions& from, const JointPositions& to, double slack = 0.0);
/// Its sentence alone.
[[nodiscard]] std::string
leaves_zone(const ArmModel& arm, const JointPositions& from, const JointPositions& to, double slack = 0.0);

} // namespace millwright::arm
