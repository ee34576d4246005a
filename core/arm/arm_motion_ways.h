// The blocks of a motion file as ways of the tool. Lengths mm, angles rad, in the base's frame.
#pragma once

#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_path.h"

#include <filesystem>
#include <vector>

namespace millwright::arm {

/// F of blocks before the first that tells one, mm/s: the default of Saengsasri, Nittayachin 1996.
inline constexpr double default_arm_feed = 10.0;

/// Throws Error with file and line for an impossible arc, and for a feed that is not above 0: wherever the
/// arm stands.
void expect_arcs(const std::vector<ArmBlock>& blocks, const std::filesystem::path& file);

/// One way a block, from where the joints `start` bring the tool on, to a billionth of a millimetre; blocks
/// that do not move the tip have no length. Arcs lie in the plane of start, end and center; where those are
/// on a line, in the XY plane, which the line must not leave then. A new tool axis is reached evenly along
/// its block. Throws Error with file and line for arcs that are none.
[[nodiscard]] std::vector<ArmWay> ways_of(const ArmModel& arm,
                                          const std::vector<ArmBlock>& blocks,
                                          const JointPositions& start,
                                          const std::filesystem::path& file);

/// Whether a block has an F.
[[nodiscard]] bool sets_feed(const std::vector<ArmBlock>& blocks);

} // namespace millwright::arm
