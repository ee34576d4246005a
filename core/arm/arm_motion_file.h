// The motion files of Saengsasri, Nittayachin 1996, KMITL: blocks of words that end with ';', every
// coordinate counted from where the tool stands. docs/reference/arm.md tells the words.
#pragma once

#include "core/arm/arm_path.h"
#include "core/geometry/vectors.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::arm {

enum class ArmMotion { line = 1, clockwise = 2, counter_clockwise = 3 };

/// One block. Lengths mm.
struct ArmBlock {
    ArmMotion motion = ArmMotion::line;
    Vec3 way = Vec3::Zero();       ///< from where the tool stands to the target
    std::optional<Vec3> center;    ///< of an arc, from where the tool stands (I J K)
    std::optional<double> radius;  ///< of an arc; negative: the long way round
    std::optional<Vec3> tool_axis; ///< unit (A B C); where it is not given it stays
    std::optional<double> feed;    ///< F, as written
    std::optional<double> spindle; ///< S
    std::optional<int> auxiliary;  ///< M
    int line = 0;                  ///< where the block begins
};

/// Letters of either case; G is modal and 1 at the beginning; an axis that is not named does not move. Throws
/// Error with line and column for anything else, for numbers that are none, repeated words, arcs without a
/// center, and for a last block without its ';'.
[[nodiscard]] std::vector<ArmBlock> parse_arm_motion(std::string_view text,
                                                     const std::filesystem::path& file);

// The blocks of a motion file as ways of the tool. Lengths mm, angles rad, in the base's frame.

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
