// How fast that is, against the micro-controller that the thesis measured (section 5.3). Clocks and
// frequencies in, times and speeds out.
#pragma once

#include <cstdint>

namespace millwright::cordic {

/// An MCS-51 at 8 MHz needs so many clocks for one line (measured there on a pin, 1.337 ms).
inline constexpr std::int64_t mcs51_line_clocks = 10'696;
inline constexpr double mcs51_clock_hz = 8e6;

struct LineTime {
    std::int64_t clocks = 0;
    double seconds = 0.0;
    double most_rpm = 0.0;    ///< of an axis whose every turn needs one line: 60 / seconds
    double reduction = 0.0;   ///< of the clocks against the MCS-51, as a fraction
    double times_fewer = 0.0; ///< clocks of the MCS-51 in parts of these
};

[[nodiscard]] LineTime line_time(std::int64_t clocks, double clock_hz);

} // namespace millwright::cordic
