// Work on tracks, one after another or side by side.
#pragma once

#include "core/base/parallel.h"
#include "core/base/progress.h"

#include <atomic>
#include <cstddef>

namespace millwright::grid {

/// Calls `body` for each track in parallel and tells `progress` how many are done.
template <typename Body> void each_track(std::ptrdiff_t count, const Progress& progress, Body body) {
    std::atomic<int> done = 0;
    parallel_for(count, 1, [&](std::ptrdiff_t t) {
        progress.check();
        body(static_cast<std::size_t>(t));
        progress.report(static_cast<double>(++done) / static_cast<double>(count));
    });
}

} // namespace millwright::grid
