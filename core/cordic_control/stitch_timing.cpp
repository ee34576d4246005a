#include "core/cordic_control/stitch_timing.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::cordic {
StitchTimes stitch_times(const StitchSettings& sewing, double compute_seconds) {
    expects(sewing.needle_rpm > 0.0 && sewing.screw_pitch > 0.0 && sewing.needle_down < 1.0,
            "a machine that sews");
    constexpr double seconds_per_minute = 60.0;
    StitchTimes times;
    times.period = seconds_per_minute / sewing.needle_rpm;
    times.window = (1.0 - sewing.needle_down) * times.period;
    times.screw_rpm =
        sewing.stitch * sewing.needle_rpm / (sewing.screw_pitch - sewing.needle_down * sewing.screw_pitch);
    times.share = compute_seconds / times.period;
    times.computed_in_time = compute_seconds <= times.period;
    times.moved_in_time = times.screw_rpm <= sewing.most_screw_rpm;
    return times;
}

std::vector<Stitch>
stitches_of(const Processor& processor, double clock_hz, const std::array<double, 2>& start) {
    expects(clock_hz > 0.0, "a processor's clock runs");
    std::vector<Stitch> stitches;
    std::int64_t clock = 0;
    std::array<double, 2> at = start;
    for (const Published& record : processor.published()) {
        const SetPoint<double> set = processor.set_point(record);
        stitches.push_back({.compute_seconds = static_cast<double>(record.clock - clock) / clock_hz,
                            .length = std::hypot(set.x - at[0], set.y - at[1])});
        clock = record.clock;
        at = {set.x, set.y};
    }
    return stitches;
}

StitchTiming time_stitches(const StitchSettings& sewing, std::span<const Stitch> stitches) {
    StitchTiming run;
    run.stitches = std::ssize(stitches);
    for (std::size_t n = 0; n < stitches.size(); ++n) {
        StitchSettings one = sewing;
        one.stitch = stitches[n].length;
        const StitchTimes times = stitch_times(one, stitches[n].compute_seconds);
        run.longest = std::max(run.longest, stitches[n].length);
        run.slowest_computation = std::max(run.slowest_computation, stitches[n].compute_seconds);
        run.late_computations += times.computed_in_time ? 0 : 1;
        run.late_moves += times.moved_in_time ? 0 : 1;
        if (!(times.computed_in_time && times.moved_in_time)) {
            run.late.push_back(n);
        }
    }
    return run;
}

} // namespace millwright::cordic
