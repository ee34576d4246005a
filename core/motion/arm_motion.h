// Motion of an arm: joint moves, and ways of its tool, as one program of its joints for the planner. Corners
// are rounded within the settings of the plan (program::PathMode::continuous). Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_path.h"
#include "core/program/program.h"

#include <filesystem>
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

} // namespace millwright::motion
