// What an arm makes of a path, in numbers for people. Lengths mm, angles rad, times s.
#pragma once

#include "core/kinematics/arm_path.h"

#include <string>
#include <vector>

namespace millwright::kinematics {

/// A finding with its place in the program.
struct ArmHole {
    int first_line = 0, last_line = 0; ///< 0: of no program
    double length = 0.0;               ///< of the path
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;
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

} // namespace millwright::kinematics
