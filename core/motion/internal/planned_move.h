// One move on its own: direction, limits and the speeds that the program asks for along it.
#pragma once

#include "core/motion/internal/mechanism.h"
#include "core/motion/planner.h"
#include "core/program/program.h"

#include <limits>
#include <vector>

namespace millwright::motion::internal {

/// Up to `end` of the scaled length.
struct FeedStep {
    double end = 0.0;
    double speed = 0.0; ///< scaled
};

struct PlannedMove {
    int block = 0;
    double length = 0.0;                 ///< scaled
    kinematics::AxisPositions unit;      ///< scaled, of length 1
    kinematics::AxisPositions direction; ///< by the way, in axis units
    bool rapid = false;
    std::vector<FeedStep> feed; ///< of a rapid: the top speed of the axes
    double axis_speed = 0.0;    ///< the top speed of the axes
    double speed = 0.0;         ///< that it never exceeds, by axes and feed with the highest override
    double acceleration = 0.0;
    Cause speed_cause, acceleration_cause;
    double path_acceleration =
        std::numeric_limits<double>::infinity(); ///< of the linear axes together, mm/s2
    program::PathControl path;
};

/// The direction from `from` to `to` in scaled axes, of length 1.
[[nodiscard]] kinematics::AxisPositions unit_of(const std::vector<AxisLimits>& limits,
                                                const kinematics::AxisPositions& from,
                                                const kinematics::AxisPositions& to);

/// The limits of a machine's axes.
[[nodiscard]] std::vector<AxisLimits> limits_of(const Mechanism& machine);

/// The move from `from` to `to`, which must differ. The linear axes together accelerate along it by
/// `path_acceleration` mm/s2 at most.
[[nodiscard]] PlannedMove planned_move_of(const Mechanism& machine,
                                          const std::vector<AxisLimits>& limits,
                                          const PlannerSettings& settings,
                                          const program::Block& block,
                                          const kinematics::AxisPositions& from,
                                          const kinematics::AxisPositions& to,
                                          double path_acceleration = std::numeric_limits<double>::infinity());

// The speed along a block at which the tool tip goes along the part at a given feed: |J q'| s' = feed, with
// the Jacobian J of the tip and the direction q' of the axes.

struct StraightWay {
    const kinematics::AxisPositions& from;
    const kinematics::AxisPositions& to;
    double length = 0.0; ///< scaled
};

/// Speeds that never take the tip above `feed` (mm/s), in so many steps that most of the way comes close to
/// it. Where the tip hardly moves they are infinite.
[[nodiscard]] std::vector<FeedStep>
part_speeds(const Mechanism& machine, const StraightWay& way, double feed);

// The speed through a corner that is not rounded.

/// By the settings' rule for corners; infinite where the way goes straight on.
[[nodiscard]] double corner_speed(const Mechanism& machine,
                                  const PlannerSettings& settings,
                                  const PlannedMove& before,
                                  const PlannedMove& after);

} // namespace millwright::motion::internal
