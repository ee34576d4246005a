// What the motion controller behind the CORDIC processor makes of its records: set-points and commands, in
// their order, as a program that a planner can put in time. Lengths mm, speeds mm/s.
#pragma once

#include "core/cordic/processor.h"
#include "core/gcode/program.h"
#include "core/gcode/reader/cordic_program.h"
#include "core/kinematics/machine_model.h"

#include <filesystem>

namespace millwright::gcode {

/// A machine of X, Y and Z without limits of travel, as fast as the records ask: along no path does it
/// accelerate by more than `acceleration` mm/s2; with `jerk` mm/s3 > 0 that changes gradually (S-curve), else
/// at once (trapezoid). Throws Error for numbers that are not positive and finite.
[[nodiscard]] kinematics::MachineModel cordic_machine(double acceleration, double jerk = 0.0);

/// All that `processor` published so far on the machine's axes, from `start`; other axes than X, Y and Z stay
/// where they are. A set-point becomes a straight feed at the speed sqrt(Vx^2 + Vy^2 + Vz^2). `made` gives
/// the lines that blocks come from; it may be of no program. Throws Error naming the set-point that has no
/// speed; `file` is what it is called.
[[nodiscard]] Program cordic_motion(const cordic::Processor& processor,
                                    const CordicProgram& made,
                                    const kinematics::MachineModel& machine,
                                    const kinematics::AxisPositions& start,
                                    const std::filesystem::path& file);

} // namespace millwright::gcode
