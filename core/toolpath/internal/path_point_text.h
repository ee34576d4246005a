// What is said of a path point that cannot be run.
#pragma once

#include "core/toolpath/toolpath.h"

#include <string>

namespace millwright::toolpath {

/// Throws Error with the point's number, node and tip, and `why`.
[[noreturn]] void refuse_point(std::size_t n, const PathPoint& point, const std::string& why);

} // namespace millwright::toolpath
