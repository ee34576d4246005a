// Motion of an arm: joint moves, and ways of its tool, as one program of its joints for the planner. Corners
// are rounded within the settings of the plan (gcode::PathMode::continuous). Lengths mm, angles rad.
#pragma once

#include "core/gcode/program.h"
#include "core/kinematics/arm_path.h"

#include <filesystem>
#include <vector>

namespace millwright::motion {

class ArmMotion {
public:
    /// From `start`, at rest. The arm must outlive it. Throws Error if a joint is outside of its limits.
    ArmMotion(const kinematics::ArmModel& arm, const kinematics::JointPositions& start);
    ArmMotion(kinematics::ArmModel&&, const kinematics::JointPositions&) = delete;

    /// All joints at once, in `seconds` or as fast as they can; the tool goes anywhere between. Throws Error
    /// where a joint would leave its limits, Defect for what is not finite.
    void go_to(const kinematics::JointPositions& joints, double seconds = 0.0);
    /// The tool along a path that the arm can follow from where it stands, and a joint move to its beginning.
    /// Throws Error with the line in `file` of the first finding, and does nothing.
    void follow(const std::vector<kinematics::ArmWay>& ways,
                const kinematics::ArmPath& path,
                const std::filesystem::path& file);

    [[nodiscard]] const kinematics::JointPositions& joints() const;
    [[nodiscard]] const gcode::Program& program() const { return program_; }

private:
    const kinematics::ArmModel& arm_;
    gcode::Program program_;

    void add(gcode::BlockKind kind, const kinematics::JointPositions& joints, double seconds, int line);
};

} // namespace millwright::motion
