// A motion file worked off by an arm: points along every line and arc, and the joints that reach them,
// written as the program of Saengsasri, Nittayachin 1996 wrote them. Lengths mm, angles rad.
#pragma once

#include "core/kinematics/arm_model.h"
#include "core/kinematics/arm_motion_file.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::kinematics {

struct ArmRecord {
    Vec3 tip = Vec3::Zero(); ///< in single precision, as the results have it
    JointPositions joints;
    int block = 0; ///< from 0
};

/// Where the arm of the thesis begins: the upper arm upright, the forearm level, the tool axis up.
[[nodiscard]] JointPositions arm_home();

/// Points about `step_mm` apart: u = 0, step / ceil(length), ... and the target where u does not meet it, so
/// that the end of one block and the begin of the next are two records. The ways are those of ways_of(). The
/// tool axis stays in the plane of the arm, as near as possible to what is told. Throws Error with file and
/// line where the arm does not reach.
[[nodiscard]] std::vector<ArmRecord> simulate_arm(const ArmModel& arm,
                                                  const std::vector<ArmBlock>& blocks,
                                                  const JointPositions& start,
                                                  double step_mm,
                                                  const std::filesystem::path& file);

/// The first three joints of each, from where the first record stands, deg: what a card of three axes is
/// told.
[[nodiscard]] std::vector<std::array<double, 3>> first_turns_deg(const std::vector<ArmRecord>& records);

/// The result file, byte for byte in its layout: position and five joints a record, five decimals.
[[nodiscard]] std::string arm_result_text(const std::vector<ArmRecord>& records);

/// Reads it back. Throws Error with the line of what is no record.
[[nodiscard]] std::vector<ArmRecord> parse_arm_result(std::string_view text,
                                                      const std::filesystem::path& file);

} // namespace millwright::kinematics
