#include "core/motion/internal/stretches.h"

#include "core/base/numbers.h"
#include "core/motion/internal/profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace millwright::motion::internal {

namespace {

Profile programmed_speeds(const Path& path, const Reach& reach, const Override& rates) {
    std::vector<Zone> zones;
    for (auto step = std::ranges::upper_bound(path.programmed, reach.filtered, {}, &ProgrammedStep::end);
         step != path.programmed.end() && (zones.empty() || zones.back().end < reach.end);
         ++step) {
        const double speed = step->speed * (step->rapid ? rates.rapid : rates.feed);
        zones.push_back(
            {std::min(step->end, reach.end), speed, 0.5 * path.filter_time * speed, {}, step->rests});
    }
    return profile_of(zones, reach.filtered);
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

double squared_after(double squared_speed, const Stretch& stretch) {
    return squared_speed + 2.0 * stretch.acceleration * (stretch.end - stretch.begin);
}

/// One pass backward from rest at the end of stretch `last` to the begin of `first`, in squared speeds.
void brake_back(const std::vector<Stretch>& stretches,
                std::size_t first,
                std::size_t last,
                std::vector<double>& squared) {
    squared[last + 1] = 0.0;
    for (std::size_t n = last + 1; n-- > first;) {
        const double before = n > 0 ? stretches[n - 1].speed : stretches[n].speed;
        const double most = square(std::min(before, stretches[n].speed));
        squared[n] = std::min(most, squared_after(squared[n + 1], stretches[n]));
    }
}

/// Of each block that is not passed yet the last stretch, which ends with it.
std::vector<std::size_t> last_stretches(const Path& path, const std::vector<Stretch>& stretches) {
    std::vector<std::size_t> last;
    std::size_t n = 0;
    for (const Segment& segment : path.segments) {
        if (!(segment.length > 0.0) || !(segment.end() > stretches.front().begin)) {
            continue;
        }
        while (n + 1 < stretches.size() && !(stretches[n + 1].end > segment.end())) {
            ++n;
        }
        last.push_back(n);
    }
    return last;
}

void brake_within(const Path& path, const std::vector<Stretch>& stretches, std::vector<double>& squared) {
    const std::vector<std::size_t> last = last_stretches(path, stretches);
    std::vector<double> window(squared.size());
    std::size_t first = 0;
    for (std::size_t block = 0; block < last.size(); ++block) {
        const std::size_t seen = std::min(block + static_cast<std::size_t>(path.look_ahead), last.size()) - 1;
        brake_back(stretches, first, last[seen], window);
        squared[0] = block == 0 ? window[0] : squared[0];
        while (first <=
               last[block]) { // the speed at its begin was decided without the last block that is seen
            ++first;
            squared[first] = window[first];
        }
    }
}

} // namespace

std::vector<Stretch> stretches_of(const Path& path, const Reach& reach, const Override& rates) {
    const double begin = reach.begin;
    const double end = reach.end;
    const Profile programmed = programmed_speeds(path, reach, rates);
    std::vector<Stretch> stretches;
    stretches.reserve(2 * programmed.size());
    Walk axis_speed(path.speed, begin);
    Walk acceleration(path.acceleration, begin);
    Walk wanted(programmed, begin);
    double from = begin;
    auto block = std::ranges::upper_bound(path.segments, begin, {}, &Segment::end);
    while (from < end && !axis_speed.done() && !acceleration.done() && !wanted.done()) {
        double to = std::min({axis_speed.step().end, acceleration.step().end, wanted.step().end});
        if (path.look_ahead > 0 && block != path.segments.end()) { // so that no stretch is of two blocks
            to = std::min(to, block->end());
        }
        const double top = axis_speed.step().value;
        stretches.push_back({from, to, top, std::min(top, wanted.step().value), acceleration.step().value});
        axis_speed.pass(to);
        acceleration.pass(to);
        wanted.pass(to);
        from = to;
        while (block != path.segments.end() && !(block->end() > from)) {
            ++block;
        }
    }
    return stretches;
}

std::vector<double> allowed_speeds(const Path& path, const std::vector<Stretch>& stretches) {
    std::vector<double> speeds(stretches.size() + 1, 0.0);
    if (stretches.empty()) {
        return speeds;
    }
    if (path.look_ahead > 0) {
        brake_within(path, stretches, speeds);
    } else {
        brake_back(stretches, 0, stretches.size() - 1, speeds);
    }
    for (double& speed : speeds) {
        speed = std::sqrt(speed);
    }
    return speeds;
}

std::size_t settled(const Path& path, const std::vector<Stretch>& stretches, double until) {
    if (stretches.empty()) {
        return 0;
    }
    if (path.look_ahead > 0) {
        const std::vector<std::size_t> last = last_stretches(path, stretches);
        const auto known = std::ranges::count_if(path.segments, [&](const Segment& segment) {
            return segment.length > 0.0 && segment.end() > stretches.front().begin &&
                   !(segment.end() > until);
        });
        return known > path.look_ahead ? last[static_cast<std::size_t>(known - path.look_ahead - 1)] + 1 : 0;
    }
    // Braking for rest behind the last stretch, and not braking at all: all that follows is between the two.
    double least = 0.0;
    double most = square(stretches.back().speed);
    for (std::size_t n = stretches.size(); n-- > 1;) {
        const double limit = square(std::min(stretches[n - 1].speed, stretches[n].speed));
        least = std::min(limit, squared_after(least, stretches[n]));
        most = std::min(limit, squared_after(most, stretches[n]));
        if (!(most > least) && !(stretches[n].begin > until)) {
            return n;
        }
    }
    return 0;
}

std::vector<double>
reached_speeds(const std::vector<Stretch>& stretches, const std::vector<double>& allowed, double speed) {
    std::vector<double> speeds(stretches.size() + 1, 0.0);
    for (std::size_t n = 0; n < stretches.size(); ++n) {
        const Stretch& stretch = stretches[n];
        speeds[n] = speed;
        const double gain = 2.0 * stretch.acceleration * (stretch.end - stretch.begin);
        if (square(speed) - gain > square(allowed[n + 1])) { // too fast for what the program wants
            const bool last = n + 1 == stretches.size();
            speed = std::min({std::sqrt(square(speed) - gain),
                              stretch.axis_speed,
                              last ? 0.0 : stretches[n + 1].axis_speed});
        } else {
            speed = std::min(std::sqrt(square(speed) + gain), allowed[n + 1]);
        }
    }
    speeds.back() = speed;
    return speeds;
}

} // namespace millwright::motion::internal
