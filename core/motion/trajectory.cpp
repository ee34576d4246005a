#include "core/motion/trajectory.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

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

namespace {

constexpr double at_the_limit = 1.0 - 1e-9; // of an axis: what rounding leaves of it

/// The axis that uses most of its limit.
struct Use {
    int axis = -1;
    double share = 0.0;
};

Use greatest_use(const Path& path, const kinematics::AxisPositions& values, double AxisLimits::*limit) {
    Use use;
    for (std::size_t n = 0; n < path.limits.size(); ++n) {
        const double share = std::abs(values[static_cast<Eigen::Index>(n)]) / (path.limits[n].*limit);
        if (share > use.share) {
            use = {static_cast<int>(n), share};
        }
    }
    return use;
}

Cause cause(Limit limit, int axis) {
    return {limit, static_cast<std::int8_t>(axis)};
}

} // namespace

Trajectory::Trajectory(std::shared_ptr<const Path> path, Timing timing, Schedule schedule)
    : path_(std::move(path)), timing_(std::move(timing)), first_block_(schedule.first_block),
      standing_done_(schedule.standing_done) {
    expects(path_ != nullptr && first_block_ >= 0, "a trajectory has a path");
    expects(first_block_ + std::ssize(schedule.ends) <= path_->block_count() &&
                (!schedule.ends.empty() || block_count() == 0),
            "a trajectory executes blocks of its path");
    times_.reserve(schedule.ends.size() + 1);
    times_.push_back(0.0);
    times_.insert(times_.end(), schedule.ends.begin(), schedule.ends.end());
    expects(std::isfinite(times_.back()) && std::ranges::is_sorted(times_),
            "the blocks of a trajectory end one after another");
}

int Trajectory::axis_count() const {
    return static_cast<int>(path_->positions.front().size());
}

int Trajectory::last_block() const {
    return first_block_ + static_cast<int>(times_.size()) - 2;
}

std::size_t Trajectory::index_of(int block) const {
    expects(block >= first_block_ && block <= last_block(), "the trajectory executes the block asked for");
    return static_cast<std::size_t>(block - first_block_);
}

int Trajectory::block_at(double time) const {
    expects(!std::isnan(time), "a time is not NaN");
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const auto index = static_cast<int>(after - times_.begin()) - 1;
    return std::clamp(first_block_ + index, first_block_, std::max(first_block_, last_block()));
}

Trajectory::Place Trajectory::place_at(double time) const {
    Place place;
    place.block = block_at(time);
    time = std::clamp(time, 0.0, duration());
    place.motion = timing_.at(time);
    const Segment& block = segment(place.block);
    const std::size_t n = index_of(place.block);
    if (block.length > 0.0) {
        place.offset = std::clamp(place.motion.way - block.start, 0.0, block.length);
        if (!(place.motion.way < block.end())) {
            place.offset = block.length; // exactly
        }
        place.fraction = place.offset / block.length;
    } else if (block.standing_time > 0.0) {
        const double done = time - times_[n] + (n == 0 ? standing_done_ : 0.0);
        place.fraction = std::clamp(done / block.standing_time, 0.0, 1.0);
    }
    return place;
}

Sample Trajectory::at(double time) const {
    Sample sample;
    if (block_count() == 0) {
        expects(!std::isnan(time), "a time is not NaN");
        sample.position = path_->positions.front();
        sample.velocity = sample.acceleration = sample.jerk =
            kinematics::AxisPositions::Zero(sample.position.size());
        return sample;
    }
    const Place place = place_at(time);
    const PathDerivatives point = path_->at(place.block, place.offset);
    const Motion& s = place.motion;
    sample.block = place.block;
    sample.fraction = place.fraction;
    sample.position = point.position;
    sample.velocity = point.first * s.speed;
    sample.acceleration = point.first * s.acceleration + point.second * square(s.speed);
    sample.jerk = kinematics::AxisPositions::Zero(sample.position.size());
    if (timing_.filter_time() > 0.0) {
        sample.jerk = point.first * s.jerk + 3.0 * s.speed * s.acceleration * point.second +
                      square(s.speed) * s.speed * point.third;
    }
    return sample;
}

double Trajectory::start_of(int block) const {
    return times_[index_of(block)];
}

double Trajectory::end_of(int block) const {
    return times_[index_of(block) + 1];
}

double Trajectory::time_at(int block, double fraction) const {
    const std::size_t n = index_of(block);
    const Segment& asked = segment(block);
    if (fraction <= 0.0) {
        return times_[n];
    }
    if (fraction >= 1.0) {
        return times_[n + 1];
    }
    if (asked.length > 0.0) {
        return timing_.time_of(asked.start + fraction * asked.length, times_[n], times_[n + 1]);
    }
    const double done = n == 0 ? standing_done_ : 0.0;
    return std::clamp(times_[n] + fraction * asked.standing_time - done, times_[n], times_[n + 1]);
}

double Trajectory::part_length_at(double time) const {
    if (block_count() == 0) {
        return 0.0;
    }
    const Place place = place_at(time);
    const auto n = static_cast<std::size_t>(place.block);
    return mix(path_->part_length[n], path_->part_length[n + 1], place.fraction);
}

double Trajectory::time_at_part_length(double length) const {
    if (block_count() == 0) {
        return 0.0;
    }
    const auto& lengths = path_->part_length;
    const auto after = std::upper_bound(lengths.begin() + 1, lengths.end(), length);
    if (after == lengths.end()) {
        return duration();
    }
    const auto n = static_cast<std::size_t>(after - lengths.begin()) - 1;
    const int block = std::clamp(static_cast<int>(n), first_block_, last_block());
    const double fraction = (length - lengths[n]) / (lengths[n + 1] - lengths[n]);
    return time_at(block, std::clamp(fraction, 0.0, 1.0));
}

// The limit that is in force shows itself: an axis at its jerk, at its acceleration, at its velocity. Else
// the unfiltered motion knows, at the middle of what the filter sees.
Cause Trajectory::limit_at(double time) const {
    if (block_count() == 0) {
        return {};
    }
    const Sample now = at(time);
    const Place place = place_at(time);
    if (!(place.motion.speed > 0.0) && !(std::abs(place.motion.acceleration) > 0.0) &&
        !(segment(place.block).length > 0.0)) {
        return {};
    }
    const Use velocity = greatest_use(*path_, now.velocity, &AxisLimits::velocity);
    if (velocity.share > at_the_limit) {
        return cause(Limit::axis_velocity, velocity.axis);
    }
    if (std::abs(place.motion.jerk) > 0.0) {
        return cause(Limit::axis_jerk, greatest_use(*path_, now.jerk, &AxisLimits::jerk).axis);
    }
    const double middle = std::clamp(time, 0.0, duration()) - 0.5 * timing_.filter_time();
    const Motion raw = timing_.unfiltered_at(middle);
    if (std::abs(raw.acceleration) > 0.0) {
        return cause(Limit::axis_acceleration,
                     greatest_use(*path_, now.acceleration, &AxisLimits::acceleration).axis);
    }
    const auto step = std::ranges::lower_bound(path_->speed, raw.way, {}, &Step::end);
    const bool by_axes = step != path_->speed.end() && raw.speed > at_the_limit * step->value;
    return by_axes ? step->cause : cause(Limit::programmed_feed, -1);
}

Cause Trajectory::limit_of(int block) const {
    const std::size_t n = index_of(block);
    if (!(segment(block).length > 0.0)) {
        return {};
    }
    return limit_at(mix(times_[n], times_[n + 1], 0.5));
}

} // namespace millwright::motion
