// A program: what one machine shall do, block by block, in its own axis coordinates. Lengths mm, angles rad,
// times s, speeds mm/s. Positions are programmed ones (zero offsets not yet added), as in the listing.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/path_mode.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::program {

enum class BlockKind {
    comment,
    spindle_on, ///< at `Block::spindle_rpm`, clockwise if that is positive
    spindle_off,
    coolant_on,
    coolant_off,
    dwell, ///< stands for `Block::duration`
    pause, ///< stands until a person goes on; `Block::pause` and `text` say what for
    rapid, ///< straight in axis space, as fast as the axes can
    feed,  ///< straight in axis space, in `Block::duration`
    end
};

/// What a pause waits for.
enum class PauseKind : std::uint8_t {
    program_stop,  ///< M0
    pallet_change, ///< M60
    optional_stop, ///< M1: only while the machine's switch for these is on
    tool_change    ///< M6
};

/// "M0", "M60", "M1", "M6".
[[nodiscard]] std::string_view code_of(PauseKind pause);

/// What a move is for.
enum class MoveRole { none, approach, plunge, cut, link, retract };

/// A set of axes, one bit an axis index.
class AxisSet {
public:
    AxisSet() = default;
    [[nodiscard]] static AxisSet all(int axes);
    [[nodiscard]] static AxisSet only(int axis);
    [[nodiscard]] bool contains(int axis) const { return ((bits_ >> axis) & 1U) != 0; }
    void insert(int axis) { bits_ |= 1U << axis; }

    friend bool operator==(const AxisSet&, const AxisSet&) = default;

private:
    unsigned bits_ = 0;
};

struct Block {
    BlockKind kind = BlockKind::comment;
    MoveRole role = MoveRole::none;
    kinematics::AxisPositions target;          ///< after the block, exactly as written; every block has one
    AxisSet named;                             ///< axes that a move positions, the others are where they were
    PauseKind pause = PauseKind::program_stop; ///< of a pause
    double duration = 0.0;                     ///< feed: of the move, s; dwell: s
    double feed = 0.0;                         ///< feed: mean speed of the tool tip on the part, mm/s
    /// feed: there if the program has not said where one of its axes is before it, so that the move has a
    /// speed and no length (`duration` is that from Program::start). mm/s along linear axes, else rad/s.
    std::optional<double> programmed_speed;
    double spindle_rpm = 0.0;
    int path_point = -1;             ///< the point of the tool path where the block ends, or -1
    int source_line = 0;             ///< of the G-code file that it was read from, from 1; 0: none
    std::optional<PathControl> path; ///< of a move, up to its end; none: the program does not say
    std::string text;                ///< of a comment or a pause

    [[nodiscard]] bool moves() const { return kind == BlockKind::rapid || kind == BlockKind::feed; }
};

struct ProgramAxis {
    char letter = 'X';
    kinematics::AxisKind kind = kinematics::AxisKind::linear;

    friend bool operator==(const ProgramAxis&, const ProgramAxis&) = default;
};

/// The tool that a program calls. A control adds `length_offset` to the programmed positions of Z.
struct ProgramTool {
    int number = 1;             ///< of T and H
    double length_offset = 0.0; ///< by how much it is longer than the tool of the machine's zeros, mm

    friend bool operator==(const ProgramTool&, const ProgramTool&) = default;
};

/// What a program was made for, and says in a comment, since G-code has no word for a diameter.
struct ProgramCutter {
    int number = 1;                        ///< of T; 0: no tool is called
    double diameter = 0.0;                 ///< > 0, mm
    std::optional<double> corner_radius{}; ///< mm; half of the diameter: a ball; nullopt: not known
    std::optional<double> half_angle{};    ///< of a cone, between axis and flank, rad
    double tip_diameter = 0.0;             ///< of a cone's flat end, mm; 0: a point or a round end
    std::string kind{};                    ///< as "flat end mill"; may be empty

    friend bool operator==(const ProgramCutter&, const ProgramCutter&) = default;
};

struct Program {
    std::string machine;                  ///< name of the machine it was made for
    std::vector<ProgramAxis> axes;        ///< in the order of MachineModel::axes()
    kinematics::AxisPositions start;      ///< where the axes are taken to be before the first block
    std::optional<ProgramTool> tool;      ///< called before the first block; nullopt: the one in the spindle
    std::vector<ProgramCutter> cutters{}; ///< of the tools that it uses, as far as they are known
    std::vector<Block> blocks;

    [[nodiscard]] int block_count() const { return static_cast<int>(blocks.size()); }
};

/// Where the axes stand before block `n`.
[[nodiscard]] const kinematics::AxisPositions& position_before(const Program& program, int n);

/// `positions` of the axes as the text of `program` says them: Z without the length offset of its tool.
[[nodiscard]] kinematics::AxisPositions programmed(const Program& program,
                                                   kinematics::AxisPositions positions);

/// The block after which the tool is at each of `point_count` points of the tool path (points that need no
/// move share the block of the point before); -1 where there is none.
[[nodiscard]] std::vector<int> blocks_of_points(const Program& program, int point_count);

} // namespace millwright::program
