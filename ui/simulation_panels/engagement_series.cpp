#include "ui/simulation_panels/engagement_series.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace millwright::panels {

namespace {

constexpr double no_feed = std::numeric_limits<double>::quiet_NaN();

void raise(double& value, double to) {
    value = std::isfinite(value) ? std::max(value, to) : to;
}

} // namespace

EngagementSeries engagement_series(std::span<const simulation::FeedEngagement> feeds,
                                   const motion::Trajectory& trajectory,
                                   int columns) {
    expects(columns >= 2, "a series has two columns or more");
    const auto count = static_cast<std::size_t>(columns);
    EngagementSeries series;
    for (std::vector<double>* curve : {&series.rate, &series.air, &series.depth, &series.width}) {
        curve->assign(count, no_feed);
    }
    const double duration = trajectory.duration();
    for (int n = 0; n < columns; ++n) {
        series.time.push_back(duration * n / (columns - 1));
    }
    const auto column_at = [&](double time) {
        const double share = duration > 0.0 ? std::clamp(time / duration, 0.0, 1.0) : 0.0;
        return static_cast<std::size_t>(std::lround(share * (columns - 1)));
    };
    for (const simulation::FeedEngagement& feed : feeds) {
        const std::size_t first = column_at(trajectory.start_of(feed.block));
        const std::size_t last = column_at(trajectory.end_of(feed.block));
        for (std::size_t n = first; n <= last; ++n) {
            if (feed.in_air()) {
                raise(series.air[n], 0.0);
                continue;
            }
            raise(series.rate[n], feed.rate());
            raise(series.depth[n], feed.depth);
            raise(series.width[n], feed.width);
        }
    }
    for (std::size_t n = 0; n < count; ++n) {
        series.air[n] = std::isfinite(series.rate[n]) ? no_feed : series.air[n];
    }
    return series;
}

} // namespace millwright::panels
