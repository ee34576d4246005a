#include "core/emulators/grbl/internal/planner.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace millwright::emulators::internal {

namespace {

constexpr int steps_per_mm = 100;
constexpr int max_rate = 110;
constexpr int max_acceleration = 120;
constexpr int junction_deviation = 11;
constexpr double percent = 0.01;
constexpr double straight = 0.999999; // cosine beyond which a corner counts as straight, or as a full turn

double length_of(const Axes& v) {
    return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

} // namespace

/// The greatest amount along `unit` that keeps each axis within its own.
double Planner::limit_along(int first_setting, const Axes& unit) const {
    double limit = std::numeric_limits<double>::max();
    for (std::size_t axis = 0; axis < eeprom_->axis_count; ++axis) {
        const double part = std::abs(unit[axis]);
        if (part > 0.0) {
            limit = std::min(limit, eeprom_->axis_setting(first_setting, axis) / part);
        }
    }
    return limit;
}

double Planner::nominal_speed(const PlannedBlock& block) const {
    if (block.move.rapid) {
        return block.fastest * overrides_.rapid * percent;
    }
    const double programmed = block.move.inverse_time ? block.move.rate * block.length : block.move.rate;
    const double scaled = block.move.overridable ? programmed * overrides_.feed * percent : programmed;
    constexpr double slowest = 1.0 / seconds_per_minute; // Grbl never goes slower than 1 mm/min
    return std::min(block.fastest, std::max(slowest, scaled));
}

double Planner::exit_speed() const {
    return blocks_.size() > 1 ? blocks_[1].entry : 0.0;
}

/// The circle that touches both lines and stays within the junction deviation of the corner is gone round at
/// the acceleration of the axes; nothing really goes along it.
double Planner::corner_speed(const PlannedBlock& before, const PlannedBlock& after) const {
    double cosine = 0.0; // of the angle between the way back and the way on: -1 is straight on
    Axes change{};
    for (std::size_t n = 0; n < change.size(); ++n) {
        cosine -= before.unit[n] * after.unit[n];
        change[n] = after.unit[n] - before.unit[n];
    }
    if (cosine > straight) {
        return 0.0;
    }
    if (cosine < -straight) {
        return std::numeric_limits<double>::max();
    }
    const double size = length_of(change);
    for (double& part : change) {
        part /= size;
    }
    const double acceleration = limit_along(max_acceleration, change);
    const double sine_half = std::sqrt(0.5 * (1.0 - cosine));
    return std::sqrt(acceleration * eeprom_->setting(junction_deviation) * sine_half / (1.0 - sine_half));
}

bool Planner::add(const Move& move) {
    expects(free_blocks() > 0, "the planner has room for the block");
    PlannedBlock block;
    block.move = move;
    block.from = position_;
    bool moves = false;
    for (std::size_t n = 0; n < eeprom_->axis_count; ++n) {
        const double steps = eeprom_->axis_setting(steps_per_mm, n);
        const double whole = std::round(move.target[n] * steps) / steps;
        block.move.target[n] = whole;
        block.unit[n] = whole - position_[n];
        moves = moves || std::abs(block.unit[n]) * steps > 0.5;
    }
    if (!moves) {
        return false;
    }
    block.length = length_of(block.unit);
    for (double& part : block.unit) {
        part /= block.length;
    }
    block.acceleration = limit_along(max_acceleration, block.unit);
    block.fastest = limit_along(max_rate, block.unit) / seconds_per_minute;
    block.top_corner = blocks_.empty() ? 0.0 : corner_speed(blocks_.back(), block);
    position_ = block.move.target;
    blocks_.push_back(block);
    plan_speeds();
    return true;
}

void Planner::drop_first() {
    blocks_.pop_front();
    offset_ = 0.0;
}

void Planner::clear() {
    blocks_.clear();
    offset_ = speed_ = 0.0;
}

void Planner::stand_at(const Axes& position) {
    clear();
    position_ = position;
}

void Planner::set_overrides(const PlannerOverrides& overrides) {
    overrides_ = overrides;
    plan_speeds();
}

void Planner::replan(double offset, double speed) {
    offset_ = offset;
    speed_ = speed;
    plan_speeds();
}

/// One pass backward: what can still be braked; one forward: what can be reached from where the first is.
void Planner::plan_speeds() {
    double next = 0.0;
    for (std::size_t n = blocks_.size(); n-- > 1;) {
        PlannedBlock& block = blocks_[n];
        const double nominal = std::min(nominal_speed(block), nominal_speed(blocks_[n - 1]));
        const double braked = std::sqrt(next * next + 2.0 * block.acceleration * block.length);
        block.entry = std::min({block.top_corner, nominal, braked});
        next = block.entry;
    }
    double speed = speed_;
    for (std::size_t n = 0; n + 1 < blocks_.size(); ++n) {
        const double way = blocks_[n].length - (n == 0 ? offset_ : 0.0);
        const double reached = std::sqrt(speed * speed + 2.0 * blocks_[n].acceleration * std::max(0.0, way));
        blocks_[n + 1].entry = std::min(blocks_[n + 1].entry, reached);
        speed = blocks_[n + 1].entry;
    }
}

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
