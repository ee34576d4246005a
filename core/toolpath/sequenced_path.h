// A path with the axis positions of its points, chosen by what a person wants least of.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/parametric_surface.h"
#include "core/toolpath/sequencing.h"

namespace millwright::toolpath {

// More points where the rotary axes turn fast, which is next to the machine's singular points: there a short
// move over the surface turns an axis by half a turn, and the tool swings away from the surface meanwhile.

/// `toolpath` with points put into those moves inside tracks along which a rotary axis turns by more than
/// `largest_step` (rad, 1e-4 to pi), at equal shares of the rotation: the axes are followed from the move's
/// first position in `axes` along the parameters between its ends. Then no axis turns by more from point to
/// point, unless it has to on the singular point itself or is then taken on another branch. A new point has
/// the node that the move leads to, and its own parameters; its tool stands as the path's tool is to stand.
/// Throws Error where a pose between cannot be reached or has no normal; Cancelled.
[[nodiscard]] Toolpath with_small_rotations(const geometry::ParametricSurface& patch,
                                            const kinematics::MachineModel& machine,
                                            const Toolpath& toolpath,
                                            const AxisPath& axes,
                                            double largest_step,
                                            const Progress& progress);

enum class SequencingGoal {
    nearest, ///< one point after another, the nearest branch (sequence)
    travel,  ///< over the whole path least travel of the rotary axes (travel_costs)
    error,   ///< over the whole path least sum of length error^2 (error_costs)
    time     ///< over the whole path least time at the axes' largest velocities (time_costs)
};

struct SequencingSettings {
    SequencingGoal goal = SequencingGoal::nearest;
    double largest_step = 0.0; ///< of a rotary axis in a move inside a track, rad, 1e-4 to pi; 0: any
    double feed = 10.0;        ///< mm/s, for the time
    bool links_cut = false;    ///< the moves from track to track are on the part, so that their error counts

    friend bool operator==(const SequencingSettings&, const SequencingSettings&) = default;
};

struct SequencedPath {
    Toolpath toolpath; ///< with more points where `largest_step` wants them
    AxisPath axes;
};

/// Throws Error as `sequence` does; Cancelled.
[[nodiscard]] SequencedPath sequenced(const geometry::ParametricSurface& patch,
                                      const kinematics::MachineModel& machine,
                                      Toolpath toolpath,
                                      const SequencingSettings& settings,
                                      const Progress& progress);

} // namespace millwright::toolpath
