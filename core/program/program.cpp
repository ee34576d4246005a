#include "core/program/program.h"

#include "core/base/error.h"

namespace millwright::program {

AxisSet AxisSet::all(int axes) {
    AxisSet set;
    set.bits_ = (1U << axes) - 1U;
    return set;
}

AxisSet AxisSet::only(int axis) {
    AxisSet set;
    set.bits_ = 1U << axis;
    return set;
}

std::string_view code_of(PauseKind pause) {
    switch (pause) {
    case PauseKind::program_stop:
        return "M0";
    case PauseKind::pallet_change:
        return "M60";
    case PauseKind::optional_stop:
        return "M1";
    case PauseKind::tool_change:
        return "M6";
    }
    return {};
}

const kinematics::AxisPositions& position_before(const Program& program, int n) {
    expects(n >= 0 && n <= program.block_count(), "a block belongs to its program");
    return n == 0 ? program.start : program.blocks[static_cast<std::size_t>(n) - 1].target;
}

kinematics::AxisPositions programmed(const Program& program, kinematics::AxisPositions positions) {
    for (std::size_t n = 0; program.tool && n < program.axes.size(); ++n) {
        if (program.axes[n].letter == 'Z') {
            positions[static_cast<Eigen::Index>(n)] -= program.tool->length_offset;
        }
    }
    return positions;
}

std::vector<int> blocks_of_points(const Program& program, int point_count) {
    std::vector<int> blocks(static_cast<std::size_t>(point_count), -1);
    for (int n = 0; n < program.block_count(); ++n) {
        const Block& block = program.blocks[static_cast<std::size_t>(n)];
        expects(block.path_point < point_count, "a block's point belongs to the tool path");
        if (block.path_point < 0) {
            continue;
        }
        int& found = blocks[static_cast<std::size_t>(block.path_point)];
        found =
            found < 0 || block.moves() ? n : found; // the end of the program belongs to its last point, too
    }
    for (std::size_t point = 1; point < blocks.size(); ++point) {
        if (blocks[point] < 0) {
            blocks[point] = blocks[point - 1];
        }
    }
    return blocks;
}

} // namespace millwright::program
