// What the ranks of one mpirun tell, gathered at rank 0.
#pragma once

#include "app/ranks.h"
#include "core/base/progress.h"

#include <functional>
#include <stop_token>
#include <string>

namespace millwright::app {

using Tell = std::function<void(const std::string& bytes)>;

/// At rank 0: does its `own` work in a thread and hears of it and of the others'; `heard` is called with each
/// message, `over` after each look whether that was all, both by the caller's thread. False: the user, or
/// mpirun for a rank that is gone, said stop before it was over; then it waits half a second for who answers.
[[nodiscard]] bool gather(const Ranks& ranks,
                          const std::function<void(const Tell&, const std::stop_token&)>& own,
                          const std::function<void(int from, const std::string& bytes)>& heard,
                          const std::function<bool()>& over,
                          const Progress& progress);

} // namespace millwright::app
