// What the ranks of one mpirun tell, gathered at rank 0.
#pragma once

#include "app/ranks.h"
#include "core/base/progress.h"

#include <functional>
#include <stop_token>
#include <string>

namespace millwright::app {

using Tell = std::function<void(const std::string& bytes)>;

/// All but `own` by the caller's thread.
struct GatheredWork {
    std::function<void(const Tell&, const std::stop_token&)> own;  ///< of rank 0, in a thread
    std::function<void(int from, const std::string& bytes)> heard; ///< each message, those of rank 0 too
    std::function<bool()> over;                                    ///< asked after each look
    std::function<void()> given_up; ///< nobody answers any more; rank 0 may be at its own work yet
};

/// At rank 0: does its own work and hears of it and of the others'. False: the user, or mpirun for a rank
/// that is gone, said stop before it was over; then who answers is waited for, but not for long: mpirun
/// kills.
[[nodiscard]] bool gather(const Ranks& ranks, const GatheredWork& work, const Progress& progress);

} // namespace millwright::app
