// A path with the axis positions of its points, chosen by what a person wants least of.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/parametric_surface.h"
#include "core/toolpath/sequencing.h"

namespace millwright::toolpath {

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
