// A motion file worked off by an arm: points along every line and arc, and the joints that reach them,
// written as the program of Saengsasri, Nittayachin 1996 wrote them. Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_model.h"
#include "core/arm/arm_motion_file.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::arm {

struct ArmRecord {
    Vec3 tip = Vec3::Zero(); ///< in single precision, as the results have it
    JointPositions joints;
    int block = 0;     ///< from 0
    double tilt = 0.0; ///< between the tool axis and the one that is asked for, rad
};

/// Points about `step_mm` apart: u = 0, step / ceil(length), ... and the target where u does not meet it, so
/// that the end of one block and the begin of the next are two records. The ways are those of ways_of(). An
/// arm with six joints or more keeps the direction of the tool, others its axis, as near as they can. Throws
/// Error with file and line where the arm does not reach, with the stretch of points that this is true of,
/// and how far they are off.
[[nodiscard]] std::vector<ArmRecord> simulate_arm(const ArmModel& arm,
                                                  const std::vector<ArmBlock>& blocks,
                                                  const JointPositions& start,
                                                  double step_mm,
                                                  const std::filesystem::path& file);

/// The first three joints of each, from where the first record stands, deg: what a card of three axes is
/// given. Throws Error unless the arm begins with three joints that turn.
[[nodiscard]] std::vector<std::array<double, 3>> first_turns_deg(const ArmModel& arm,
                                                                 const std::vector<ArmRecord>& records);

/// The result file, byte for byte in its layout: position and joints of each record, mm and degrees, five
/// decimals.
[[nodiscard]] std::string arm_result_text(const ArmModel& arm, const std::vector<ArmRecord>& records);

/// Reads it back. Throws Error with the line of what is no record of this arm.
[[nodiscard]] std::vector<ArmRecord>
parse_arm_result(const ArmModel& arm, std::string_view text, const std::filesystem::path& file);

} // namespace millwright::arm
