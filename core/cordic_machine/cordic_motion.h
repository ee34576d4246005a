// What the motion controller behind the CORDIC processor makes of its records: set-points and commands, in
// their order, as a program that a planner can put in time. Lengths mm, speeds mm/s.
#pragma once

#include "core/cordic/processor.h"
#include "core/cordic_machine/cordic_program.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"

#include <filesystem>
#include <limits>
#include <vector>

namespace millwright::cordic_machine {

/// That the records ask for, mm/s2; 0 if none moves.
[[nodiscard]] double greatest_acceleration(const cordic::Processor& processor);

/// A machine of X, Y and Z without limits of travel, as fast as the records ask. Each axis may accelerate by
/// `acceleration` mm/s2; with `jerk` mm/s3 > 0 that changes gradually (S-curve), else at once (trapezoid).
/// Throws Error for numbers that are not positive and finite.
[[nodiscard]] kinematics::MachineModel cordic_machine(double acceleration, double jerk = 0.0);

/// What the records say, for motion::plan_within().
struct CordicMotion {
    program::Program program;
    std::vector<double> accelerations; ///< of each block, mm/s2
};

/// All that `processor` published so far on the machine's axes, from `start`; other axes than X, Y and Z stay
/// where they are. A set-point becomes a straight feed at the speed sqrt(Vx^2 + Vy^2 + Vz^2), along which all
/// axes together accelerate by sqrt(Ax^2 + Ay^2 + Az^2), by `most_acceleration` mm/s2 at most. `made` gives
/// the lines that blocks come from; it may be of no program. Throws Error naming the set-point that has no
/// speed or acceleration; `file` is what it is called.
[[nodiscard]] CordicMotion cordic_motion(const cordic::Processor& processor,
                                         const CordicProgram& made,
                                         const kinematics::MachineModel& machine,
                                         const kinematics::AxisPositions& start,
                                         const std::filesystem::path& file,
                                         double most_acceleration = std::numeric_limits<double>::infinity());

} // namespace millwright::cordic_machine
