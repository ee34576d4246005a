#include "core/cordic_study/comparison.h"

#include "core/base/error.h"

namespace millwright::cordic {
LineTime line_time(std::int64_t clocks, double clock_hz) {
    expects(clocks > 0 && clock_hz > 0.0, "a line takes clocks of a running clock");
    constexpr double seconds_per_minute = 60.0;
    const auto count = static_cast<double>(clocks);
    const double seconds = count / clock_hz;
    return {.clocks = clocks,
            .seconds = seconds,
            .most_rpm = seconds_per_minute / seconds,
            .reduction = 1.0 - count / static_cast<double>(mcs51_line_clocks),
            .times_fewer = static_cast<double>(mcs51_line_clocks) / count};
}

} // namespace millwright::cordic
