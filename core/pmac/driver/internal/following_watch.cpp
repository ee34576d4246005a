#include "core/pmac/driver/internal/following_watch.h"

#include <cmath>

namespace millwright::pmac::internal {

namespace {

constexpr double least_lag = 0.25;     // degrees: of what is more than a loop that settles
constexpr double least_progress = 0.1; // of the lag, within the patience: a weak loop goes further
constexpr double patience = 0.5;       // s
constexpr int least_looks = 5;         // a computer that was busy for so long has seen nothing

} // namespace

std::optional<std::size_t>
FollowingWatch::left_behind(const std::vector<double>& lags, const std::vector<double>& places, double now) {
    for (std::size_t n = 0; n < watched_.size(); ++n) {
        std::optional<Since>& since = watched_[n];
        const double lag = std::abs(lags[n]);
        const bool forwards = lags[n] > 0.0;
        if (lag < least_lag) {
            since.reset();
            continue;
        }
        const double progress = since ? (places[n] - since->place) * (forwards ? 1.0 : -1.0) : 0.0;
        if (!since || since->forwards != forwards || progress >= least_progress * lag) {
            since = Since{places[n], now, forwards, 0};
            continue;
        }
        if (progress < 0.0) {
            since->place = places[n]; // the wrong way, or its zero was found: progress counts from there
        }
        if (++since->looks >= least_looks && now - since->time >= patience) {
            return n;
        }
    }
    return std::nullopt;
}

} // namespace millwright::pmac::internal
