#include "core/drivers/internal/jog_feed.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::drivers::internal {

namespace {

using Axes = JogFeed::Axes;

constexpr double slices_under_way = 6;   // so that Grbl's 15 blocks hold what is allowed
constexpr double shortest_slice = 0.005; // mm: about a step
constexpr double there = 0.02;           // mm: as near as reports tell
constexpr double same_direction = 1.0 - 1e-9;

/// The least of `limits` along `direction`.
double along(const Axes& direction, const Axes& limits) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index n = 0; n < direction.size(); ++n) {
        const double part = std::abs(direction[n]);
        least = part > 0.0 ? std::min(least, limits[n] / part) : least;
    }
    return least;
}

/// The longest way that a machine of speed u, which does not exceed v, ends within u / a and the spare time:
/// it speeds up to a peak, goes on at v if it gets that far, and brakes.
double way_within_promise(double u, double v, double a, double spare) {
    const double peak = std::min(v, u + 0.5 * a * spare);
    const double cruise_time = spare - 2.0 * (peak - u) / a;
    return (square(peak) - 0.5 * square(u)) / a + peak * std::max(0.0, cruise_time);
}

} // namespace

void JogFeed::begin(const Axes& position) {
    legs_.clear();
    target_ = position;
    direction_ = Axes::Zero(position.size());
}

void JogFeed::add(const Jog& jog) {
    const double length = jog.way.norm();
    const Eigen::Index axes = target_.size();
    const bool usable = jog.way.size() <= axes && jog.way.allFinite() && length > 0.0 && jog.speed > 0.0 &&
                        std::isfinite(jog.speed) && jog.dead_man >= 0.0;
    expects(usable, "a jog has a length and a speed");
    Leg leg{.direction = Axes::Zero(axes), .length = length, .speed = jog.speed, .sent_to = Axes::Zero(axes)};
    leg.direction.head(jog.way.size()) = jog.way / length;
    if (jog.dead_man > 0.0) {
        const bool goes_on = !legs_.empty() && legs_.front().direction.dot(leg.direction) > same_direction;
        if (goes_on) {
            legs_.front().length = legs_.front().sent + length;
            legs_.front().speed = jog.speed;
            legs_.resize(1);
            return;
        }
        legs_.clear();
    }
    legs_.push_back(leg);
}

std::optional<JogSlice> JogFeed::next(const Axes& position, double feed, const JogLimits& limits) {
    if (legs_.empty()) {
        return std::nullopt;
    }
    Leg& leg = legs_.front();
    const double under_way = (target_ - position).norm();
    const bool turns = direction_.dot(leg.direction) < same_direction;
    if (turns && under_way > there) {
        return std::nullopt; // to rest first, so that `under_way` is all of the way
    }
    const double leg_speed = std::min(leg.speed, along(leg.direction, limits.rate));
    const double speed = std::min(feed, leg_speed);
    const double a = along(leg.direction, limits.acceleration);
    const double allowed = way_within_promise(speed, leg_speed, a, limits.spare_time);
    const double left = leg.length - leg.sent;
    double slice = std::max(allowed / slices_under_way, shortest_slice);
    slice = left < 1.2 * slice ? left : slice; // no crumbs
    if (under_way + slice > allowed && under_way > 0.5 * shortest_slice) {
        return std::nullopt;
    }
    direction_ = leg.direction;
    const JogSlice next = take(leg, slice);
    if (slice >= left) {
        legs_.pop_front();
    }
    return next;
}

JogSlice JogFeed::take(Leg& leg, double length) {
    constexpr double finest = 1e-4; // mm or degree, as printed: the roundings do not add up
    leg.sent += length;
    JogSlice slice{.way = Axes::Zero(target_.size()), .speed = leg.speed};
    for (Eigen::Index n = 0; n < slice.way.size(); ++n) {
        const double to = std::round(leg.sent * leg.direction[n] / finest) * finest;
        const double way = to - leg.sent_to[n];
        leg.sent_to[n] = to;
        target_[n] += way;
        slice.way[n] = std::abs(way) > 0.5 * finest ? way : 0.0;
    }
    return slice;
}

} // namespace millwright::drivers::internal
