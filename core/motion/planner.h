// The look-ahead planner: as fast as the program and the axes allow, ending at rest. Speeds along the whole
// path by one pass backward (what can still be braked) and one forward (what can be reached); then a filter
// in time limits the jerk (trajectory.h). Formulas and proofs: docs/reference/motion.md.
//
// Corners: in exact path mode the path is followed exactly, and the velocity of an axis changes in a corner
// by a step. In continuous mode corners are rounded within a tolerance, and no axis exceeds any limit. Apart
// from the steps no axis ever exceeds its velocity, acceleration or jerk.
#pragma once

#include "core/arm/arm_model.h"
#include "core/base/progress.h"
#include "core/motion/trajectory.h"
#include "core/program/program.h"

#include <optional>
#include <span>

namespace millwright::motion {

/// How fast corners that are not rounded are passed.
enum class CornerRule : std::uint8_t {
    small_step,        ///< every axis changes its velocity by max_acceleration * corner_time at most
    junction_deviation ///< as fast as a circle that stays within the deviation of the corner could be
                       ///< followed
};

/// What a programmed feed means.
enum class FeedRule : std::uint8_t {
    programmed_time, ///< a block takes the time that it carries, if the axes can (inverse time feed)
    on_part          ///< the tip goes along the part at Block::feed, nowhere faster
};

struct PlannerSettings {
    program::PathControl path;        ///< of moves that do not say
    double rounding_tolerance = 0.01; ///< of a continuous path without a tolerance of its own, mm, > 0
    double rounding_angle = 0.001;    ///< by which a rounding may turn a rotary axis off the path, rad, > 0
    CornerRule corner_rule = CornerRule::small_step;
    double corner_time = 0.002;       ///< s, >= 0
    double junction_deviation = 0.01; ///< mm, degrees of rotary axes counted as mm (as Grbl does), >= 0
    FeedRule feed_rule = FeedRule::programmed_time;
    int look_ahead = 0; ///< blocks that are known at a time, to predict a small controller; 0: all

    friend bool operator==(const PlannerSettings&, const PlannerSettings&) = default;
};

/// Plans from `start`, or from the program's own start if none is given. Blocks that are no moves stop the
/// axes (comments do not), moves of no length take no time. The duration of the trajectory is the time
/// estimate. Throws Error if the program's axes are not the machine's, Defect if a target is not finite or a
/// setting out of range.
[[nodiscard]] Trajectory plan(const program::Program& program,
                              const kinematics::MachineModel& machine,
                              const PlannerSettings& settings,
                              const Progress& progress,
                              const std::optional<kinematics::AxisPositions>& start = std::nullopt);

/// The same for the joints of an arm, called '1' to '9' in the program; "on the part" is in the base's frame.
[[nodiscard]] Trajectory plan(const program::Program& program,
                              const arm::ArmModel& arm,
                              const PlannerSettings& settings,
                              const Progress& progress);

// The plan of a program that allows its blocks less acceleration than the axes have.

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
