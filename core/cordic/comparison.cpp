#include "core/cordic/comparison.h"

#include "core/base/error.h"

#include <algorithm>

namespace millwright::cordic {
namespace {

constexpr double seconds_a_minute = 60.0;

} // namespace

LineTime line_time(std::int64_t clocks, double clock_hz) {
    expects(clocks > 0 && clock_hz > 0.0, "a line takes clocks of a running clock");
    const auto count = static_cast<double>(clocks);
    const double seconds = count / clock_hz;
    return {.clocks = clocks,
            .seconds = seconds,
            .most_rpm = seconds_a_minute / seconds,
            .reduction = 1.0 - count / static_cast<double>(mcs51_line_clocks),
            .times_fewer = static_cast<double>(mcs51_line_clocks) / count};
}

StitchTimes stitch_times(const Sewing& sewing, double compute_seconds) {
    expects(sewing.needle_rpm > 0.0 && sewing.screw_pitch > 0.0 && sewing.needle_down < 1.0,
            "a machine that sews");
    StitchTimes times;
    times.period = seconds_a_minute / sewing.needle_rpm;
    times.window = (1.0 - sewing.needle_down) * times.period;
    times.screw_rpm = sewing.stitch / sewing.screw_pitch / times.window * seconds_a_minute;
    times.share = compute_seconds / times.period;
    times.computed_in_time = compute_seconds <= times.period;
    times.moved_in_time = times.screw_rpm <= sewing.most_screw_rpm;
    return times;
}

SewingRun
sew(const Sewing& sewing, std::span<const double> compute_seconds, std::span<const double> lengths_mm) {
    expects(compute_seconds.size() == lengths_mm.size(), "one time and one length a stitch");
    SewingRun run;
    for (std::size_t n = 0; n < lengths_mm.size(); ++n) {
        Sewing one = sewing;
        one.stitch = lengths_mm[n];
        const StitchTimes times = stitch_times(one, compute_seconds[n]);
        run.longest = std::max(run.longest, lengths_mm[n]);
        run.slowest_computation = std::max(run.slowest_computation, compute_seconds[n]);
        run.late_computations += times.computed_in_time ? 0 : 1;
        run.late_moves += times.moved_in_time ? 0 : 1;
        if (run.first_late < 0 && !(times.computed_in_time && times.moved_in_time)) {
            run.first_late = static_cast<std::int64_t>(n);
        }
    }
    run.stitches = static_cast<std::int64_t>(lengths_mm.size());
    return run;
}

} // namespace millwright::cordic
