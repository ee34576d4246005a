// The groups of colours of the KMITL master's thesis of 2006 (forming software for wood and plastic): red
// (and white), yellow, green, cyan, blue, magenta.
#pragma once

namespace millwright::plot {

inline constexpr int pen_groups = 6;

/// 0 to 5: pen 1 is red; beyond the sixth they begin anew, below the first backwards.
[[nodiscard]] constexpr int pen_group(int pen) {
    return (pen % pen_groups - 1 + pen_groups) % pen_groups;
}

} // namespace millwright::plot
