// Random programs for tests of what is written: moves of every kind on one machine, inside of its limits.
#pragma once

#include "core/base/units.h"
#include "core/program/program.h"
#include "tests/support/programs.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::test {

/// A place within 100 mm and 1 rad of the physical zero, inside the limits.
inline kinematics::AxisPositions random_positions(const kinematics::MachineModel& machine,
                                                  std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    kinematics::AxisPositions q = kinematics::AxisPositions::Zero(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        const kinematics::MachineAxis& axis = machine.axis(n);
        const bool rotary = axis.kind == kinematics::AxisKind::rotary;
        const double zero = rotary ? -axis.zero_offset : 0.0;
        q[n] = std::clamp(zero + unit(random) * (rotary ? 1.0 : 100.0), axis.min, axis.max);
    }
    return q;
}

/// Spindle, coolant, rapids, feeds, a dwell and a pause, with the axes that move now and then only some.
inline program::Program
random_moves(const kinematics::MachineModel& machine, int count, std::mt19937& random) {
    program::Program program = empty_program(machine);
    std::uniform_real_distribution<double> duration(0.2, 5.0);
    std::uniform_int_distribution<int> die(0, 9);
    add_block(program, program::BlockKind::comment);
    program.blocks.back().text = "random (moves)";
    add_block(program, program::BlockKind::spindle_on);
    program.blocks.back().spindle_rpm = die(random) < 5 ? 9000.0 : -1200.0;
    add_block(program, program::BlockKind::coolant_on);
    kinematics::AxisPositions q = program.start;
    for (int n = 0; n < count; ++n) {
        const kinematics::AxisPositions next = random_positions(machine, random);
        const bool some = die(random) < 3;
        for (int axis = 0; axis < machine.axis_count(); ++axis) {
            if (!some || die(random) < 5) {
                q[axis] = next[axis];
            }
        }
        add_move(program, q, n > 0 && die(random) < 7 ? duration(random) : 0.0);
        if (die(random) == 0) {
            add_block(program, program::BlockKind::dwell);
            program.blocks.back().duration = duration(random);
        }
    }
    add_block(program, program::BlockKind::pause);
    program.blocks.back().text = "look";
    add_block(program, program::BlockKind::coolant_off);
    add_block(program, program::BlockKind::spindle_off);
    add_block(program, program::BlockKind::end);
    return program;
}

} // namespace millwright::test
