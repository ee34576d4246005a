#include "core/emulators/grbl/internal/planner.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

} // namespace millwright::emulators::internal
