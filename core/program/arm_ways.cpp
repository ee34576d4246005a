#include "core/program/arm_ways.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"

#include <algorithm>
#include <utility>

namespace millwright::program {

namespace {

using arm::ArmWay;
using kinematics::AxisPositions;
using kinematics::MachineModel;

Frame tool_at(const MachineModel& machine, const AxisPositions& positions, const Frame& base_T_part) {
    const geometry::ToolPose pose = kinematics::forward(machine, positions);
    Frame tool = Frame::Identity();
    tool.translation() = base_T_part * pose.tip;
    tool.linear() = frame_along((base_T_part.linear() * -pose.axis).normalized());
    return tool;
}

/// The first block before which the program has given the tool's position, or the first that cuts.
int first_known(const Program& program, const MachineModel& machine) {
    AxisSet told;
    const auto known = [&] {
        return std::ranges::all_of(machine.linear_axes(), [&](int n) { return told.contains(n); });
    };
    int n = 0;
    for (; n < program.block_count() && !known(); ++n) {
        const Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.kind == BlockKind::feed) {
            break;
        }
        for (int axis = 0; block.moves() && axis < machine.axis_count(); ++axis) {
            if (block.named.contains(axis)) {
                told.insert(axis);
            }
        }
    }
    return n;
}

double path_length(const std::function<Frame(double)>& at) {
    constexpr int chords = 8; // of a way that rotary axes bend
    double length = 0.0;
    for (int k = 0; k < chords; ++k) {
        length +=
            (at((k + 1.0) / chords).translation() - at(static_cast<double>(k) / chords).translation()).norm();
    }
    return length;
}

} // namespace

std::vector<ArmWay> arm_ways(std::shared_ptr<const Program> program,
                             std::shared_ptr<const MachineModel> machine,
                             const Frame& base_T_part) {
    expects(static_cast<int>(program->axes.size()) == machine->axis_count(), "the program's machine");
    std::vector<ArmWay> ways;
    for (int n = first_known(*program, *machine); n < program->block_count(); ++n) {
        const Block& block = program->blocks[static_cast<std::size_t>(n)];
        const AxisPositions& from = position_before(*program, n);
        if (!block.moves() || (block.target - from).isZero(0.0)) {
            continue;
        }
        ArmWay way;
        way.at = [program, machine, base_T_part, n](double share) {
            const AxisPositions& before = position_before(*program, n);
            const AxisPositions& after = program->blocks[static_cast<std::size_t>(n)].target;
            return tool_at(*machine, before + share * (after - before), base_T_part);
        };
        way.length = path_length(way.at);
        way.duration = block.kind == BlockKind::feed ? block.duration : 0.0;
        way.line = block.source_line;
        ways.push_back(std::move(way));
    }
    return ways;
}

} // namespace millwright::program
