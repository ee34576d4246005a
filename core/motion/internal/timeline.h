// The timing of blocks one after another, from a state of motion or from rest.
#pragma once

#include "core/base/progress.h"
#include "core/motion/override.h"
#include "core/motion/trajectory.h"

namespace millwright::motion::internal {

/// What a motion goes on from.
struct Departure {
    int block = 0;              ///< in which the axes are
    double standing_done = 0.0; ///< of its dwell, s
    std::vector<Phase> history; ///< as Timing::history gives it
    double settling = 0.0;      ///< s that are still needed to come to rest, if the unfiltered way rests
};

/// Rest at the beginning of a path.
[[nodiscard]] Departure departure();
[[nodiscard]] Departure departure(const Trajectory& now, double time);

/// The first block that ends beyond the unfiltered way; block_count() if there is none.
[[nodiscard]] int first_block_after(const Path& path, const Departure& from);
/// The first block in which the motion can come to rest.
[[nodiscard]] int first_block_to_rest_in(const Path& path, const Departure& from);

/// To the end of block `last`, to rest there, as fast as the limits and the program allow. Throws Cancelled.
[[nodiscard]] Trajectory go_to_the_end_of(int last,
                                          std::shared_ptr<const Path> path,
                                          Departure from,
                                          const Override& rates,
                                          const Progress& progress);
/// To rest as soon as the axes allow.
[[nodiscard]] Trajectory brake_to_rest(std::shared_ptr<const Path> path, Departure from);

} // namespace millwright::motion::internal
