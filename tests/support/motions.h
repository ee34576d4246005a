// Programs in random directions, and a judge of axis limits that looks at samples only.
#pragma once

#include "core/motion/trajectory.h"
#include "tests/support/programs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

namespace millwright::test {

/// Rapids and feeds of all lengths, some of none, with comments, dwells and a spindle between them.
inline program::Program random_program(const kinematics::MachineModel& machine, int blocks, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::uniform_int_distribution<int> kind(0, 19);
    program::Program program = empty_program(machine);
    kinematics::AxisPositions q = program.start;
    kinematics::AxisPositions heading = q;
    for (int n = 0; n < blocks; ++n) {
        const int what = kind(random);
        if (what == 0) {
            add_block(program, program::BlockKind::comment);
        } else if (what == 1) {
            add_block(program, program::BlockKind::spindle_on);
        } else if (what == 2) {
            add_block(program, program::BlockKind::dwell);
            program.blocks.back().duration = 0.1;
        } else if (what == 3) {
            add_move(program, q, 0.2);
        } else {
            // Often nearly straight on, in steps from 1/1000 to 10 mm (or a twentieth of that in rad).
            const double length = std::pow(10.0, 2.0 * share(random) - 1.0);
            for (int axis = 0; axis < machine.axis_count(); ++axis) {
                const bool rotary = machine.axis(axis).kind == kinematics::AxisKind::rotary;
                heading[axis] = (what < 12 ? heading[axis] : 0.0) + (what < 12 ? 0.05 : 1.0) * share(random);
                q[axis] += length * heading[axis] * (rotary ? 0.05 : 1.0);
            }
            add_move(program, q, what % 3 == 0 ? 0.0 : 0.02 * std::abs(length) + 1e-4);
        }
    }
    return program;
}

/// A machine whose axes reach their greatest acceleration in 1 / `rate` seconds.
inline kinematics::MachineModel with_jerk(const kinematics::MachineModel& machine, double rate) {
    kinematics::MachineDescription description = machine.description();
    for (auto* axes : {&description.table, &description.head}) {
        for (kinematics::MachineAxis& axis : *axes) {
            axis.max_jerk = rate * axis.max_acceleration;
        }
    }
    return kinematics::MachineModel(std::move(description));
}

/// What is wrong with one axis between two samples `dt` apart; empty if nothing is.
inline std::string limit_fault(const kinematics::MachineAxis& axis,
                               Eigen::Index n,
                               const motion::Sample& last,
                               const motion::Sample& now,
                               double dt,
                               double corner_time) {
    constexpr double rounding = 1.0 + 1e-9;
    const int corners = now.block - last.block;
    const double change = std::abs(now.velocity[n] - last.velocity[n]);
    const double way = now.position[n] - last.position[n];
    const double mean = (now.velocity[n] + last.velocity[n]) / 2.0;
    if (!(std::abs(now.velocity[n]) <= axis.max_velocity * rounding)) {
        return "exceeds its velocity";
    }
    if (!(std::abs(now.acceleration[n]) <= axis.max_acceleration * rounding)) {
        return "exceeds its acceleration";
    }
    if (!(change <= axis.max_acceleration * (dt + corners * corner_time) * rounding + 1e-9)) {
        return "changes its velocity too much";
    }
    if (!(std::abs(way) <= axis.max_velocity * dt * rounding + 1e-9)) {
        return "goes too far";
    }
    if (corners == 0 && !(std::abs(way - mean * dt) <= axis.max_acceleration * dt * dt / 4.0 + 1e-9)) {
        return "has a velocity that is not the change of its position";
    }
    return {};
}

/// No axis exceeds its velocity anywhere, nor its acceleration but for the documented step in each corner;
/// velocity is the change of position. Stops at the first fault.
inline void expect_within_limits(const motion::Trajectory& trajectory,
                                 const kinematics::MachineModel& machine,
                                 double corner_time,
                                 int samples) {
    const double dt = trajectory.duration() / samples;
    motion::Sample last = trajectory.at(0.0);
    for (int k = 1; k <= samples; ++k) {
        const double time = k == samples ? trajectory.duration() : k * dt;
        const motion::Sample now = trajectory.at(time);
        for (int n = 0; n < machine.axis_count(); ++n) {
            const std::string fault = limit_fault(machine.axis(n), n, last, now, dt, corner_time);
            if (!fault.empty()) {
                ADD_FAILURE() << "axis " << machine.axis(n).letter << " " << fault << " at " << time
                              << " s, block " << now.block;
                return;
            }
        }
        last = now;
    }
}

} // namespace millwright::test
