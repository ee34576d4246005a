// From a program to the way of its axes: lengths, limits and corners of every block.
#pragma once

#include "core/gcode/program.h"
#include "core/motion/internal/mechanism.h"
#include "core/motion/planner.h"

namespace millwright::motion::internal {

/// As plan() describes. Throws what it throws.
[[nodiscard]] Path lay_out(const gcode::Program& program,
                           const Mechanism& machine,
                           const PlannerSettings& settings,
                           const kinematics::AxisPositions& start,
                           const Progress& progress);

} // namespace millwright::motion::internal
