#include "core/plot/internal/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace millwright::plot::internal {
namespace {

/// 2 sin(theta / 2) of the turn at a corner: how much a unit velocity changes there.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
    return ((c - b).normalized() - (b - a).normalized()).norm();
}

std::vector<double> lengths_of(const std::vector<Vec3>& points) {
    std::vector<double> lengths;
    for (std::size_t n = 1; n < points.size(); ++n) {
        lengths.push_back((points[n] - points[n - 1]).norm());
    }
    return lengths;
}

// Of the acceleration, where the way bends: across it and along it, together no more than the whole.
constexpr double across_share = 0.6;
constexpr double along_share = 0.8;
constexpr double sharp =
    0.35; ///< a turn of 20 degrees: across is no longer square to along, and it is stopped

bool bends(double change) {
    constexpr double straight = 1e-12;
    return change > straight && change < sharp;
}

/// How fast the way may become faster.
double along(const std::vector<Vec3>& points, const SpeedLimits& limits) {
    for (std::size_t n = 1; n + 1 < points.size(); ++n) {
        if (bends(turn(points[n - 1], points[n], points[n + 1]))) {
            return along_share * limits.acceleration;
        }
    }
    return limits.acceleration;
}

/// The speed through each point. A bend may change the velocity by what its share of the acceleration does in
/// a period; the short chords of an arc count as the arc that they stand for. A corner is stopped at; with a
/// limit of the jerk also a bend that is no arc.
std::vector<double> corner_speeds(const std::vector<Vec3>& points,
                                  const std::vector<double>& lengths,
                                  const SpeedLimits& limits,
                                  double acceleration) {
    std::vector<double> speeds(points.size(), 0.0);
    for (std::size_t n = 1; n + 1 < points.size(); ++n) {
        const double change = turn(points[n - 1], points[n], points[n + 1]);
        if (!bends(change)) {
            speeds[n] = change < sharp ? limits.velocity : 0.0;
            continue;
        }
        const double across = across_share * limits.acceleration;
        const double at_once = across * limits.period / change;
        const double as_arc = std::sqrt(across * std::min(lengths[n - 1], lengths[n]) / change);
        const bool corner = at_once <= as_arc && at_once < limits.velocity;
        speeds[n] = corner && limits.jerk ? 0.0 : std::min({limits.velocity, at_once, as_arc});
    }
    for (std::size_t n = 1; n < points.size(); ++n) {
        speeds[n] = std::min(speeds[n],
                             std::sqrt(speeds[n - 1] * speeds[n - 1] + 2.0 * acceleration * lengths[n - 1]));
    }
    for (std::size_t n = points.size() - 1; n > 0; --n) {
        speeds[n - 1] =
            std::min(speeds[n - 1], std::sqrt(speeds[n] * speeds[n] + 2.0 * acceleration * lengths[n - 1]));
    }
    return speeds;
}

} // namespace

SpeedProfile::SpeedProfile(const std::vector<Vec3>& points, const SpeedLimits& limits) {
    const std::vector<double> lengths = lengths_of(points);
    const double acceleration = along(points, limits);
    const std::vector<double> speeds = corner_speeds(points, lengths, limits, acceleration);
    // The acceleration may jump from one limit to the other: its mean over this time changes by the jerk
    // then.
    window_ = limits.jerk ? 2.0 * acceleration / *limits.jerk : 0.0;
    phases_.push_back({});
    for (std::size_t n = 0; n < lengths.size(); ++n) {
        add(lengths[n], speeds[n], speeds[n + 1], limits.velocity, acceleration);
        const bool standing = n + 1 == lengths.size() || !(speeds[n + 1] > 0.0);
        if (standing && window_ > 0.0) {
            add_phase(0.0, window_); // until the mean has arrived too
        }
    }
    duration_ = phases_.back().t;
    length_ = phases_.back().s;
}

// Speeds up, goes on, slows down within a segment whose ends can be reached from each other.
void SpeedProfile::add(double distance, double from, double to, double most, double acceleration) {
    const double peak =
        std::min(most, std::sqrt(std::max(0.0, acceleration * distance + 0.5 * (from * from + to * to))));
    const double top = std::max({peak, from, to});
    const double up = (top * top - from * from) / (2.0 * acceleration);
    const double down = (top * top - to * to) / (2.0 * acceleration);
    add_phase(acceleration, (top - from) / acceleration);
    add_phase(0.0, top > 0.0 ? std::max(0.0, distance - up - down) / top : 0.0);
    add_phase(-acceleration, (top - to) / acceleration);
    phases_.back().v = to; // what rounding left
}

void SpeedProfile::add_phase(double a, double duration) {
    if (!(duration > 0.0)) {
        return;
    }
    Phase& now = phases_.back();
    now.a = a;
    const double d = duration;
    phases_.push_back({.t = now.t + d,
                       .s = now.s + d * (now.v + d * a / 2.0),
                       .v = now.v + a * d,
                       .a = 0.0,
                       .area = now.area + d * (now.s + d * (now.v / 2.0 + d * a / 6.0))});
}

const SpeedProfile::Phase& SpeedProfile::phase_at(double t) const {
    const auto after = std::ranges::upper_bound(phases_, t, {}, &Phase::t);
    return after == phases_.begin() ? phases_.front() : *(after - 1);
}

double SpeedProfile::sharp_way(double t) const {
    const Phase& phase = phase_at(t);
    const double d = std::max(0.0, t - phase.t);
    return phase.s + d * (phase.v + d * phase.a / 2.0);
}

double SpeedProfile::area(double t) const {
    if (t <= 0.0) {
        return 0.0;
    }
    const Phase& phase = phase_at(t);
    const double d = t - phase.t;
    return phase.area + d * (phase.s + d * (phase.v / 2.0 + d * phase.a / 6.0));
}

double SpeedProfile::way(double t) const {
    const double s = window_ > 0.0 ? (area(t) - area(t - window_)) / window_ : sharp_way(t);
    return std::clamp(s, 0.0, length_);
}

} // namespace millwright::plot::internal
