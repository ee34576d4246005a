// The look-ahead planner: as fast as the program and the axes allow, ending at rest. Speeds along the whole
// path by one pass backward (what can still be braked) and one forward (what can be reached).
//
// Corners: until blending exists, the path is followed exactly and an axis may change its velocity in a
// corner by a step of at most max_acceleration * corner_time (3 mm/s for 1500 mm/s^2 and the default of 2 ms,
// which is what a servo follows within one or two of its cycles). Apart from these steps no axis ever exceeds
// its acceleration; none exceeds its velocity anywhere.
#pragma once

#include "core/base/progress.h"
#include "core/gcode/program.h"
#include "core/motion/trajectory.h"

#include <optional>

namespace millwright::motion {

enum class Corners {
    small_step, ///< through corners with the velocity steps described above
    exact_stop  ///< to rest after every move
};

struct PlannerSettings {
    Corners corners = Corners::small_step;
    double corner_time = 0.002; ///< s, >= 0

    friend bool operator==(const PlannerSettings&, const PlannerSettings&) = default;
};

/// Plans from `start`, or from the program's own start if none is given. Blocks that are no moves stop the
/// axes (comments do not), moves of no length take no time. The duration of the trajectory is the time
/// estimate. Throws Error if the program's axes are not the machine's, Defect if a target is not finite.
[[nodiscard]] Trajectory plan(const gcode::Program& program,
                              const kinematics::MachineModel& machine,
                              const PlannerSettings& settings,
                              const Progress& progress,
                              const std::optional<kinematics::AxisPositions>& start = std::nullopt);

} // namespace millwright::motion
