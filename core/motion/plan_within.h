// The plan of a program that allows its blocks less acceleration than the axes have.
#pragma once

#include "core/motion/planner.h"

#include <optional>
#include <span>

namespace millwright::motion {

/// As plan(); along block n the linear axes together accelerate by accelerations[n] mm/s2 > 0 at most
/// (infinity: as the axes can), and in a corner that is not rounded their velocity steps by what the smaller
/// one of both blocks reaches in the corner time. Throws what plan() throws, Defect for accelerations that
/// are not one per block.
[[nodiscard]] Trajectory plan_within(const program::Program& program,
                                     std::span<const double> accelerations,
                                     const kinematics::MachineModel& machine,
                                     const PlannerSettings& settings,
                                     const Progress& progress,
                                     const std::optional<kinematics::AxisPositions>& start = std::nullopt);

} // namespace millwright::motion
