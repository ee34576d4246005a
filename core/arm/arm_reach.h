// What an arm makes of a path, in numbers for people. Lengths mm, angles rad, times s.
#pragma once

#include "core/arm/arm_path.h"

#include <cstddef>
#include <string>
#include <vector>

namespace millwright::arm {

/// A point of a path where the arm cannot be.
struct ArmReachPoint {
    std::size_t point = 0;   ///< its number in the path, from 1
    int line = 0;            ///< of the program; 0: of none
    double along = 0.0;      ///< from the beginning of the path, mm
    Vec3 tip = Vec3::Zero(); ///< where the path has it, in the base's frame
    ArmShortfall off;
};

/// A stretch of the path that the arm cannot go: points in a row with the same trouble.
struct ArmHole {
    double length = 0.0; ///< of the path
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;                   ///< at its first point
    std::vector<ArmReachPoint> points; ///< at least one

    [[nodiscard]] const ArmReachPoint& first() const { return points.front(); }
    [[nodiscard]] const ArmReachPoint& last() const { return points.back(); }
    /// That is farthest off: by the tip, then by a joint, then by the direction of the tool.
    [[nodiscard]] const ArmReachPoint& worst() const;
};

struct ArmReach {
    double length = 0.0;  ///< of the path
    double reached = 0.0; ///< of it
    std::vector<ArmHole> holes;
    JointPositions lowest, highest; ///< that the path asks of each joint; empty if it reaches nothing
    double least_manipulability = 0.0;
    int least_line = 0; ///< where that is
    double most_tilt = 0.0;
    double programmed_time = 0.0; ///< of the ways that have one
};

[[nodiscard]] ArmReach reach_of(const ArmPath& path, const std::vector<ArmWay>& ways);

/// "out of reach", "joint limit", "tool axis", "jump"; "none".
[[nodiscard]] const char* name_of(ArmTrouble trouble);

/// "12.500 mm off, joint 2 is 3.100 deg beyond its limit": all that is not 0; of a jump "joint 1 jumps by
/// 180.000 deg".
[[nodiscard]] std::string to_text(const ArmModel& arm, ArmTrouble trouble, const ArmShortfall& off);

} // namespace millwright::arm
