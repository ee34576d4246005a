#include "core/motion/timing.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace millwright::motion {

namespace {

/// The time to cover `length` from `speed` while accelerating; stable for any of them near zero.
double time_for(double length, double speed, double acceleration) {
    const double root = std::sqrt(std::max(0.0, speed * speed + 2.0 * acceleration * length));
    return speed + root > 0.0 ? 2.0 * length / (speed + root) : 0.0;
}

double way_in(const Phase& phase, double time) {
    return (phase.speed + 0.5 * phase.acceleration * time) * time;
}

} // namespace

Timing::Timing(std::vector<Phase> phases, double filter_time)
    : phases_(std::move(phases)), filter_time_(filter_time) {
    expects(!phases_.empty() && std::isfinite(phases_.back().time) && filter_time >= 0.0,
            "a timing has phases and takes a finite time");
    expects(phases_.size() < std::numeric_limits<std::uint32_t>::max(),
            "a timing has fewer phases than 2^32");
    fill_buckets();
    if (!(filter_time_ > 0.0)) {
        return;
    }
    integrals_.reserve(phases_.size());
    Sum sum;
    for (std::size_t n = 0; n < phases_.size(); ++n) {
        integrals_.push_back(sum);
        if (n + 1 < phases_.size()) {
            const Phase& phase = phases_[n];
            const double dt = phases_[n + 1].time - phase.time;
            const double added = (phase.way + (0.5 * phase.speed + phase.acceleration / 6.0 * dt) * dt) * dt;
            const double total = sum.high + added; // two-sum: what is rounded off goes to the low part
            const double back = total - sum.high;
            sum.low += (sum.high - (total - back)) + (added - back);
            sum.high = total;
        }
    }
}

/// As many buckets as phases, so that one look and a short search find the phase of a time.
void Timing::fill_buckets() {
    const double length = end() - phases_.front().time;
    const std::size_t count = phases_.size();
    buckets_per_second_ = length > 0.0 ? static_cast<double>(count) / length : 0.0;
    buckets_.reserve(count + 2);
    std::size_t phase = 0;
    for (std::size_t n = 0; n <= count; ++n) {
        const double begin =
            phases_.front().time + length * static_cast<double>(n) / static_cast<double>(count);
        while (phase + 1 < count && !(phases_[phase + 1].time > begin)) {
            ++phase;
        }
        buckets_.push_back(static_cast<std::uint32_t>(phase));
    }
    buckets_.push_back(static_cast<std::uint32_t>(count - 1));
}

std::size_t Timing::phase_at(double time) const {
    const double since = (time - phases_.front().time) * buckets_per_second_;
    const double most = static_cast<double>(buckets_.size() - 2);
    // Rounding may place a time that is a bucket's begin into its neighbour.
    const auto bucket = static_cast<std::size_t>(std::clamp(since - 1e-6, 0.0, most));
    const auto first = phases_.begin() + static_cast<std::ptrdiff_t>(buckets_[bucket]);
    const std::size_t beyond = std::min(bucket + 2, buckets_.size() - 1);
    const auto last = phases_.begin() + static_cast<std::ptrdiff_t>(buckets_[beyond]) + 1;
    const auto after = std::upper_bound(
        first, last, time, [](double wanted, const Phase& phase) { return wanted < phase.time; });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - phases_.begin() - 1, 0));
}

Timing::State Timing::state_at(double time) const {
    const std::size_t n = phase_at(time);
    const Phase& phase = phases_[n];
    const double dt = time - phase.time;
    const bool before = dt < 0.0;
    State state;
    state.acceleration = before ? 0.0 : phase.acceleration;
    state.speed = before ? 0.0 : std::max(0.0, phase.speed + phase.acceleration * dt);
    const double done = before ? 0.0 : way_in(phase, dt);
    state.way = phase.way + done;
    if (!integrals_.empty()) {
        state.integral = integrals_[n];
        const double inner = before ? 0.0 : (0.5 * phase.speed + phase.acceleration / 6.0 * dt) * dt;
        state.integral.low += (phase.way + inner) * dt;
    }
    return state;
}

Motion Timing::unfiltered_at(double time) const {
    const State state = state_at(time);
    return {state.way, state.speed, state.acceleration, 0.0};
}

Motion Timing::at(double time) const {
    const State head = state_at(time);
    if (!(filter_time_ > 0.0)) {
        return {head.way, head.speed, head.acceleration, 0.0};
    }
    const State tail = state_at(time - filter_time_);
    const double area = (head.integral.high - tail.integral.high) + (head.integral.low - tail.integral.low);
    Motion motion;
    const double furthest = std::max(tail.way, head.way); // at rest, rounding may say otherwise
    motion.way = std::clamp(area / filter_time_, tail.way, furthest);
    motion.speed = std::max(0.0, (head.way - tail.way) / filter_time_);
    motion.acceleration = (head.speed - tail.speed) / filter_time_;
    motion.jerk = (head.acceleration - tail.acceleration) / filter_time_;
    return motion;
}

double Timing::unfiltered_time_of(double way) const {
    const auto reached = std::ranges::lower_bound(phases_, way, {}, &Phase::way);
    if (reached == phases_.begin()) {
        return phases_.front().time;
    }
    const Phase& phase = *(reached - 1);
    const double dt = time_for(way - phase.way, phase.speed, phase.acceleration);
    return reached == phases_.end() ? phase.time + dt : std::min(phase.time + dt, reached->time);
}

double Timing::time_of(double way, double from, double to) const {
    if (!(filter_time_ > 0.0)) {
        return std::clamp(unfiltered_time_of(way), from, to);
    }
    const double raw = unfiltered_time_of(way);
    from = std::max(from, raw);
    to = std::max(from, std::min(to, raw + filter_time_));
    double time = 0.5 * (from + to);
    constexpr int enough = 100;        // bisections alone need 60
    constexpr double rounding = 4e-16; // of a way
    for (int n = 0; n < enough; ++n) {
        const Motion motion = at(time);
        const double off = motion.way - way;
        if (std::abs(off) <= rounding * std::abs(way)) {
            return time;
        }
        (off < 0.0 ? from : to) = time;
        double next = motion.speed > 0.0 ? time - off / motion.speed : from;
        if (!(next > from && next < to)) {
            next = 0.5 * (from + to);
        }
        if (!(next > from && next < to)) { // no number is left between them
            return next;
        }
        time = next;
    }
    return time;
}

std::vector<Phase> Timing::history(double time) const {
    std::vector<Phase> seen;
    const std::size_t now = phase_at(time);
    for (std::size_t n = phase_at(time - filter_time_); n <= now; ++n) {
        seen.push_back(phases_[n]);
        seen.back().time -= time;
    }
    const Motion state = unfiltered_at(time);
    seen.push_back({0.0, state.way, state.speed, 0.0});
    return seen;
}

double Timing::at_rest_since(double time) const {
    std::size_t n = phase_at(time);
    const auto rests = [&](const Phase& phase) {
        return !(phase.speed > 0.0) && !(std::abs(phase.acceleration) > 0.0);
    };
    if (!rests(phases_[n])) {
        return time;
    }
    while (n > 0 && rests(phases_[n - 1])) {
        --n;
    }
    return n == 0 ? -std::numeric_limits<double>::infinity() : phases_[n].time;
}

} // namespace millwright::motion
