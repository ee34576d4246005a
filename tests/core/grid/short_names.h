// What many tests of grids say, in short.
#pragma once

#include "core/grid/grid.h"

#include <limits>

namespace millwright::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr grid::TrackDirection along_v = grid::TrackDirection::along_v;

} // namespace millwright::test
