// A program made block by block in a test.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program.h"

#include <initializer_list>
#include <utility>

namespace millwright::simulation {

/// Writes blocks for a machine, a line each from 10 on.
class WrittenProgram {
public:
    explicit WrittenProgram(const kinematics::MachineModel& machine) : machine_(machine) {
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            made_.axes.push_back({axis.letter, axis.kind});
        }
        made_.start = kinematics::AxisPositions::Zero(machine.axis_count());
        at_ = made_.start;
    }
    WrittenProgram& go(program::BlockKind kind, std::initializer_list<std::pair<char, double>> to) {
        program::Block block;
        block.kind = kind;
        for (const auto& [letter, position] : to) {
            const int axis = machine_.axis_index(letter);
            at_[axis] = position;
            block.named.insert(axis);
        }
        return add(block);
    }
    WrittenProgram& add(program::Block block) {
        block.target = at_;
        block.source_line = 10 + made_.block_count();
        made_.blocks.push_back(block);
        return *this;
    }
    void replace_last(const program::Block& block) { made_.blocks.back() = block; }
    WrittenProgram& add(program::BlockKind kind) {
        program::Block block;
        block.kind = kind;
        return add(block);
    }
    [[nodiscard]] const program::Program& program() const { return made_; }

private:
    const kinematics::MachineModel& machine_;
    program::Program made_;
    kinematics::AxisPositions at_;
};

} // namespace millwright::simulation
