// From a program to the way of its axes: lengths, limits and corners of every block.
#pragma once

#include "core/motion/internal/mechanism.h"
#include "core/motion/planner.h"
#include "core/program/program.h"

#include <span>

namespace millwright::motion::internal {

/// As plan() and, where there are `accelerations`, plan_within() describe. Throws what they throw.
[[nodiscard]] Path lay_out(const program::Program& program,
                           const Mechanism& machine,
                           const PlannerSettings& settings,
                           const kinematics::AxisPositions& start,
                           std::span<const double> accelerations,
                           const Progress& progress);

} // namespace millwright::motion::internal
