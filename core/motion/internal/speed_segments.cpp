#include "core/motion/internal/speed_segments.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/motion/internal/profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::motion::internal {

namespace {

Profile programmed_speeds(const Path& path, const WayRange& range, const Override& rates) {
    std::vector<Zone> zones;
    for (auto step = std::ranges::upper_bound(path.programmed, range.filtered, {}, &ProgrammedStep::end);
         step != path.programmed.end() && (zones.empty() || zones.back().end < range.end);
         ++step) {
        const double speed = step->speed * (step->rapid ? rates.rapid : rates.feed);
        zones.push_back(
            {std::min(step->end, range.end), speed, 0.5 * path.filter_time * speed, {}, step->rests});
    }
    return profile_of(zones, range.filtered);
}

/// Steps through a profile.
class Walk {
public:
    Walk(const Profile& profile, double begin)
        : now_(std::ranges::upper_bound(profile, begin, {}, &Step::end)), end_(profile.end()) {}

    [[nodiscard]] bool done() const { return now_ == end_; }
    [[nodiscard]] const Step& step() const { return *now_; }
    void pass(double position) {
        if (!(now_->end > position)) {
            ++now_;
        }
    }

private:
    Profile::const_iterator now_, end_;
};

double squared_after(double squared_speed, const SpeedSegment& speed_segment) {
    return squared_speed + 2.0 * speed_segment.acceleration * (speed_segment.end - speed_segment.begin);
}

/// One pass backward from rest at the end of segment `last` to the begin of `first`, in squared speeds.
void brake_back(const std::vector<SpeedSegment>& speed_segments,
                std::size_t first,
                std::size_t last,
                std::vector<double>& squared) {
    squared[last + 1] = 0.0;
    for (std::size_t n = last + 1; n-- > first;) {
        const double before = n > 0 ? speed_segments[n - 1].speed : speed_segments[n].speed;
        const double most = square(std::min(before, speed_segments[n].speed));
        squared[n] = std::min(most, squared_after(squared[n + 1], speed_segments[n]));
    }
}

/// Of each block that is not passed yet the last segment, which ends with it.
std::vector<std::size_t> last_speed_segments(const Path& path,
                                             const std::vector<SpeedSegment>& speed_segments) {
    std::vector<std::size_t> last;
    std::size_t n = 0;
    for (const Segment& segment : path.segments) {
        if (!(segment.length > 0.0) || !(segment.end() > speed_segments.front().begin)) {
            continue;
        }
        while (n + 1 < speed_segments.size() && !(speed_segments[n + 1].end > segment.end())) {
            ++n;
        }
        last.push_back(n);
    }
    return last;
}

void brake_within(const Path& path,
                  const std::vector<SpeedSegment>& speed_segments,
                  std::vector<double>& squared) {
    const std::vector<std::size_t> last = last_speed_segments(path, speed_segments);
    std::vector<double> window(squared.size());
    std::size_t first = 0;
    for (std::size_t block = 0; block < last.size(); ++block) {
        const std::size_t seen = std::min(block + static_cast<std::size_t>(path.look_ahead), last.size()) - 1;
        brake_back(speed_segments, first, last[seen], window);
        squared[0] = block == 0 ? window[0] : squared[0];
        while (first <=
               last[block]) { // the speed at its begin was decided without the last block that is seen
            ++first;
            squared[first] = window[first];
        }
    }
}

} // namespace

std::vector<SpeedSegment> speed_segments_of(const Path& path, const WayRange& range, const Override& rates) {
    const double begin = range.begin;
    const double end = range.end;
    const Profile programmed = programmed_speeds(path, range, rates);
    std::vector<SpeedSegment> speed_segments;
    speed_segments.reserve(2 * programmed.size());
    Walk axis_speed(path.speed, begin);
    Walk acceleration(path.acceleration, begin);
    Walk wanted(programmed, begin);
    double from = begin;
    auto block = std::ranges::upper_bound(path.segments, begin, {}, &Segment::end);
    while (from < end && !axis_speed.done() && !acceleration.done() && !wanted.done()) {
        double to = std::min({axis_speed.step().end, acceleration.step().end, wanted.step().end});
        if (path.look_ahead > 0 && block != path.segments.end()) { // so that no segment is of two blocks
            to = std::min(to, block->end());
        }
        const double top = axis_speed.step().value;
        speed_segments.push_back(
            {from, to, top, std::min(top, wanted.step().value), acceleration.step().value});
        axis_speed.pass(to);
        acceleration.pass(to);
        wanted.pass(to);
        from = to;
        while (block != path.segments.end() && !(block->end() > from)) {
            ++block;
        }
    }
    return speed_segments;
}

std::vector<double> allowed_speeds(const Path& path, const std::vector<SpeedSegment>& speed_segments) {
    std::vector<double> speeds(speed_segments.size() + 1, 0.0);
    if (speed_segments.empty()) {
        return speeds;
    }
    if (path.look_ahead > 0) {
        brake_within(path, speed_segments, speeds);
    } else {
        brake_back(speed_segments, 0, speed_segments.size() - 1, speeds);
    }
    for (double& speed : speeds) {
        speed = std::sqrt(speed);
    }
    return speeds;
}

std::size_t settled(const Path& path, const std::vector<SpeedSegment>& speed_segments, double until) {
    if (speed_segments.empty()) {
        return 0;
    }
    if (path.look_ahead > 0) {
        const std::vector<std::size_t> last = last_speed_segments(path, speed_segments);
        const auto known = std::ranges::count_if(path.segments, [&](const Segment& segment) {
            return segment.length > 0.0 && segment.end() > speed_segments.front().begin &&
                   !(segment.end() > until);
        });
        return known > path.look_ahead ? last[static_cast<std::size_t>(known - path.look_ahead - 1)] + 1 : 0;
    }
    // Braking for rest behind the last segment, and not braking at all: all that follows is between the two.
    double least = 0.0;
    double most = square(speed_segments.back().speed);
    for (std::size_t n = speed_segments.size(); n-- > 1;) {
        const double limit = square(std::min(speed_segments[n - 1].speed, speed_segments[n].speed));
        least = std::min(limit, squared_after(least, speed_segments[n]));
        most = std::min(limit, squared_after(most, speed_segments[n]));
        if (!(most > least) && !(speed_segments[n].begin > until)) {
            return n;
        }
    }
    return 0;
}

std::vector<double> reached_speeds(const std::vector<SpeedSegment>& speed_segments,
                                   const std::vector<double>& allowed,
                                   double speed) {
    std::vector<double> speeds(speed_segments.size() + 1, 0.0);
    for (std::size_t n = 0; n < speed_segments.size(); ++n) {
        const SpeedSegment& speed_segment = speed_segments[n];
        speeds[n] = speed;
        const double gain = 2.0 * speed_segment.acceleration * (speed_segment.end - speed_segment.begin);
        if (square(speed) - gain > square(allowed[n + 1])) { // too fast for what the program wants
            const bool last = n + 1 == speed_segments.size();
            speed = std::min({std::sqrt(square(speed) - gain),
                              speed_segment.axis_speed,
                              last ? 0.0 : speed_segments[n + 1].axis_speed});
        } else {
            speed = std::min(std::sqrt(square(speed) + gain), allowed[n + 1]);
        }
    }
    speeds.back() = speed;
    return speeds;
}

namespace {

double length_between(double slow, double fast, double acceleration) {
    return (fast - slow) * (fast + slow) / (2.0 * acceleration);
}

} // namespace

PhaseList::PhaseList(std::vector<Phase> history) : phases_(std::move(history)) {
    expects(!phases_.empty(), "a motion continues from a known state");
    time_ = phases_.back().time;
    way_ = phases_.back().way;
    phases_.pop_back();
}

void PhaseList::add(double way, double speed, double acceleration, double duration) {
    if (duration > 0.0) {
        way_ = std::max(way_, way);
        phases_.push_back({time_, way_, speed, acceleration});
        time_ += duration;
    }
}

void PhaseList::go(const SpeedSegment& speed_segment, double start_speed, double end_speed) {
    const double a = speed_segment.acceleration;
    const double length = speed_segment.end - speed_segment.begin;
    if (!(length > 0.0)) {
        return;
    }
    const double without_cruise =
        std::sqrt(std::max(0.0, (square(start_speed) + square(end_speed)) / 2.0 + a * length));
    const bool too_fast = start_speed > speed_segment.speed;
    const double peak =
        too_fast ? std::max(speed_segment.speed, end_speed)
                 : std::max({std::min(speed_segment.speed, without_cruise), start_speed, end_speed});
    const double begun =
        too_fast ? length_between(peak, start_speed, a) : length_between(start_speed, peak, a);
    const double ended = length_between(end_speed, peak, a);
    const double cruise = too_fast || without_cruise > speed_segment.speed ? length - begun - ended : 0.0;
    add(speed_segment.begin, start_speed, too_fast ? -a : a, std::abs(peak - start_speed) / a);
    if (cruise > 0.0) {
        add(speed_segment.begin + begun, peak, 0.0, cruise / peak);
    }
    add(speed_segment.end - ended, peak, -a, (peak - end_speed) / a);
    way_ = speed_segment.end;
}

void PhaseList::brake(double start_speed, double end_speed, double acceleration, double end) {
    add(way_, start_speed, -acceleration, (start_speed - end_speed) / acceleration);
    way_ = end;
}

void PhaseList::stand(double seconds) {
    add(way_, 0.0, 0.0, seconds);
}

std::vector<Phase> PhaseList::take() {
    phases_.push_back({time_, way_, 0.0, 0.0});
    return std::move(phases_);
}

} // namespace millwright::motion::internal
