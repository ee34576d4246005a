// How long a cutting path may be.
#pragma once

#include <cstddef>

namespace millwright::plot {

/// A point takes 40 bytes, and about as many where it is drawn.
inline constexpr std::size_t most_path_points = 20'000'000;

/// Throws Error if a path has more points than that.
void expect_not_too_long(std::size_t points);

} // namespace millwright::plot
