#include "core/emulators/grbl/internal/stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::emulators::internal {

namespace {

constexpr double segment_time = 0.01;
constexpr double nothing_mm = 1e-9;
constexpr double nothing_s = 1e-12;

Axes between(const Axes& from, const Axes& to, double fraction) {
    Axes at{};
    for (std::size_t n = 0; n < at.size(); ++n) {
        at[n] = from[n] + (to[n] - from[n]) * fraction;
    }
    return at;
}

Axes along(const PlannedBlock& block, double offset) {
    return between(block.from, block.move.target, std::min(1.0, offset / block.length));
}

} // namespace

void Stepper::halt() {
    segments_.clear();
    passed_ = offset_ = speed_ = 0.0;
    holding_ = false;
    planner_.stand_at(position_);
}

void Stepper::stand_at(const Axes& position) {
    position_ = position;
    halt();
}

/// One stretch of constant acceleration of at most `time`; returns how long it takes. The block ends at the
/// planned speed, or the hold at none.
double Stepper::go(const PlannedBlock& block, double time) {
    const double rest = block.length - offset_;
    const double nominal = planner_.nominal_speed(block);
    const double a = block.acceleration;
    const double exit = std::min(planner_.exit_speed(), nominal);
    const double brake_way = std::max(0.0, speed_ * speed_ - exit * exit) / (2.0 * a);
    const auto stretch = [&](double duration, double acceleration) {
        const double spent = std::min(duration, time);
        offset_ += (speed_ + 0.5 * acceleration * spent) * spent;
        speed_ = std::max(0.0, speed_ + acceleration * spent);
        return spent;
    };
    if (holding_) {
        const double root = speed_ * speed_ - 2.0 * a * rest;
        const double until = root > 0.0 ? (speed_ - std::sqrt(root)) / a : speed_ / a;
        const double spent = stretch(until, -a);
        speed_ = root <= 0.0 && spent >= until ? 0.0 : speed_;
        return spent;
    }
    if (brake_way >= rest - nothing_mm) { // to the planned speed at the end, as hard as that takes
        const double duration = 2.0 * rest / std::max(nothing_mm, speed_ + exit);
        const double spent = stretch(duration, (exit - speed_) / std::max(nothing_s, duration));
        offset_ = spent >= duration ? block.length : offset_;
        speed_ = spent >= duration ? exit : speed_;
        return spent;
    }
    if (speed_ > nominal + nothing_mm) {
        return stretch((speed_ - nominal) / a, -a);
    }
    const double peak = std::sqrt(0.5 * (speed_ * speed_ + exit * exit) + a * rest);
    if (speed_ < std::min(peak, nominal) - nothing_mm) {
        return stretch((std::min(peak, nominal) - speed_) / a, a);
    }
    return stretch((rest - brake_way) / speed_, 0.0);
}

void Stepper::prepare_segment() {
    const PlannedBlock& block = planner_.first();
    Segment segment;
    segment.from = along(block, offset_);
    segment.owner = block.move.owner;
    int stretches = 0;
    constexpr int enough = 16; // a segment has three stretches; rounding may add very short ones
    while (segment.duration < segment_time - nothing_s && block.length - offset_ > nothing_mm &&
           stretches++ < enough) {
        segment.duration += go(block, segment_time - segment.duration);
        if (holding_ && !(speed_ > 0.0)) {
            break;
        }
    }
    segment.ends_block = block.length - offset_ <= nothing_mm;
    segment.to = segment.ends_block ? block.move.target : along(block, offset_);
    if (segment.ends_block) {
        planner_.drop_first();
        offset_ = 0.0;
        speed_ = planner_.empty() ? 0.0 : speed_;
    }
    planner_.replan(offset_, speed_);
    segments_.push_back(segment);
}

void Stepper::prepare() {
    while (segments_.size() < most_segments_ && !planner_.empty() && !(holding_ && !(speed_ > 0.0))) {
        prepare_segment();
    }
}

double Stepper::next_event() {
    prepare();
    return segments_.empty() ? 0.0 : std::max(nothing_s, segments_.front().duration - passed_);
}

void Stepper::advance(double seconds) {
    prepare();
    if (segments_.empty()) {
        return;
    }
    const Segment& now = segments_.front();
    passed_ += seconds;
    const bool finished = passed_ >= now.duration - nothing_s;
    const Axes before = position_;
    position_ = finished ? now.to : between(now.from, now.to, passed_ / now.duration);
    travelled_ += std::hypot(position_[0] - before[0], position_[1] - before[1], position_[2] - before[2]);
    if (!finished) {
        return;
    }
    const Segment done = now;
    segments_.pop_front();
    passed_ = 0.0;
    if (done.ends_block) {
        done_(done.owner);
    }
    prepare();
}

} // namespace millwright::emulators::internal
