// Motion of an arm: joint moves, and ways of its tool, as one program of its joints for the planner. Corners
// are rounded within the settings of the plan (program::PathMode::continuous). Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_path.h"
#include "core/program/program.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::motion {

class ArmMotion {
public:
    /// From `start`, at rest. The arm must outlive it. Throws Error if a joint is outside of its limits.
    ArmMotion(const arm::ArmModel& arm, const arm::JointPositions& start);
    ArmMotion(arm::ArmModel&&, const arm::JointPositions&) = delete;

    /// All joints at once, in `seconds` or as fast as they can; the tool goes anywhere between. Throws Error
    /// where a joint would leave its limits, Defect for what is not finite.
    void go_to(const arm::JointPositions& joints, double seconds = 0.0);
    /// The tool along a path that the arm can follow from its position, and a joint move to its beginning.
    /// Throws Error with the line in `file` of the first finding, and does nothing.
    void
    follow(const std::vector<arm::ArmWay>& ways, const arm::ArmPath& path, const std::filesystem::path& file);

    [[nodiscard]] const arm::JointPositions& joints() const;
    [[nodiscard]] const program::Program& program() const { return program_; }

private:
    const arm::ArmModel& arm_;
    program::Program program_;

    void add(program::BlockKind kind, const arm::JointPositions& joints, double seconds, int line);
};

// Points taught to an arm, gone to one after another: the motion between them as one program of its joints.
// Lengths mm, angles rad.

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
