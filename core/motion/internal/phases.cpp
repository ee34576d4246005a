#include "core/motion/internal/phases.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::motion::internal {

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
