// Inverse kinematics of any arm by damped least squares (Levenberg-Marquardt; Sugihara 2011), for arms
// without a closed form. It finds one solution near its start, or says that it found none.
#pragma once

#include "core/arm/arm_model.h"

#include <vector>

namespace millwright::arm {

/// What of the goal has to be met: the whole frame, the tip and the tool axis (free roll), or the tip alone.
enum class ArmDemand { frame, tip_and_axis, tip };

struct ArmSolverSettings {
    double tip_tolerance = 1e-9;    ///< mm
    double angle_tolerance = 1e-12; ///< rad
    int most_iterations = 200;
    /// What a radian counts against the stretched arm's length, > 0. It decides which miss is the smallest
    /// where the goal cannot be met: far above 1 the tool keeps its direction, far below it the tip its
    /// place.
    double angle_weight = 1.0;
};

struct ArmSolverResult {
    JointPositions positions; ///< inside the limits, whether it converged or not
    bool converged = false;
    double tip_error = 0.0;   ///< mm
    double angle_error = 0.0; ///< rad; of what is demanded
    int iterations = 0;
};

/// From `start`, which is brought inside the limits first. Throws Defect if something is not finite.
[[nodiscard]] ArmSolverResult solve_arm(const ArmModel& arm,
                                        const Frame& goal,
                                        ArmDemand demand,
                                        const JointPositions& start,
                                        const ArmSolverSettings& settings = {});

/// The different solutions found from starting points that are spread evenly inside the limits (a turn to
/// each side of 0 where there are none), and from guesses at other branches of what was found: until `starts`
/// in a row have found nothing new. Nearest to `previous` first. The same for the same arguments. Where the
/// demand leaves joints free (every roll about the tool axis will do) the nearest one to `previous` stands
/// for all that hang together.
[[nodiscard]] std::vector<JointPositions> solve_arm_from_many_starts(
    const ArmModel& arm, const Frame& goal, ArmDemand demand, const JointPositions& previous, int starts);

} // namespace millwright::arm
