// Points taught to an arm, gone to one after another: the motion between them as one program of its joints.
// Lengths mm, angles rad.
#pragma once

#include "core/motion/arm_motion.h"

#include <string>
#include <vector>

namespace millwright::motion {

/// Of the tip along lines at full share: the reduced speed of ISO 10218-1 for an arm beside a person, mm/s.
inline constexpr double taught_motion_speed = 250.0;

struct ArmStop {
    std::string name; ///< for diagnostics
    arm::JointPositions joints;
    bool straight = false; ///< the tip along a line, the tool turning evenly; else joint by joint
    double share = 1.0;    ///< of taught_motion_speed, or of the joints' greatest speeds; 0 < share <= 1
};

/// From `start` through all stops. Throws Error with the name of the stop that the arm cannot go to.
[[nodiscard]] program::Program
motion_through(const arm::ArmModel& arm, const arm::JointPositions& start, const std::vector<ArmStop>& stops);
program::Program
motion_through(arm::ArmModel&&, const arm::JointPositions&, const std::vector<ArmStop>&) = delete;

/// As long as the slowest joint takes for `way` at that share of its speed, s; 0 < share <= 1.
[[nodiscard]] double joint_time(const arm::ArmModel& arm, const arm::JointPositions& way, double share);

/// The tip's straight way between two frames of the tool, which turns evenly. `speed`: mm/s; 0: as fast as
/// the joints can.
[[nodiscard]] arm::ArmWay straight_way(const Frame& from, const Frame& to, double speed);

} // namespace millwright::motion
