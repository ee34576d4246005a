#include "core/gcode_programs/programmed_feed.h"

#include "core/base/numbers.h"
#include "core/base/units.h"

#include <cmath>
#include <initializer_list>

namespace millwright::gcode {

namespace {

constexpr double seconds_per_minute = 60.0;

double distance_along_axes(const AxisValues& a, const AxisValues& b, std::initializer_list<Axis> axes) {
    double sum = 0.0;
    for (const Axis axis : axes) {
        sum += square(b[axis] - a[axis]);
    }
    return std::sqrt(sum);
}

} // namespace

double linear_distance(const AxisValues& a, const AxisValues& b) {
    return distance_along_axes(a, b, {Axis::x, Axis::y, Axis::z});
}

void ProgrammedFeed::command(const Command& command, double unit) {
    switch (command.kind) {
    case CommandKind::set_feed_rate:
        rate_ = command.value * unit;
        angular_rate_ = command.value;
        break;
    case CommandKind::set_feed_mode:
        per_revolution_ = command.index == 1;
        break;
    case CommandKind::set_spindle_mode:
        surface_speed_ = command.value > 0.0;
        break;
    case CommandKind::start_speed_feed_synch:
        a_revolution_ = command.value * unit;
        break;
    case CommandKind::stop_speed_feed_synch:
        a_revolution_ = 0.0;
        break;
    case CommandKind::set_spindle_speed:
        rpm_ = command.value;
        break;
    default:
        break;
    }
}

std::optional<double> ProgrammedFeed::times_per_minute() const {
    if (!per_revolution_) {
        return 1.0;
    }
    return surface_speed_ ? std::nullopt : std::optional(rpm_);
}

std::optional<double> ProgrammedFeed::duration(const AxisValues& from, const AxisValues& to) const {
    double way = linear_distance(from, to);
    if (way <= same_place) {
        way = distance_along_axes(from, to, {Axis::u, Axis::v, Axis::w});
    }
    if (way > same_place) {
        return duration(way);
    }
    way = distance_along_axes(from, to, {Axis::a, Axis::b, Axis::c});
    if (way <= same_place) {
        return 0.0;
    }
    const double rate = angular_rate();
    return rate > 0.0 ? std::optional(way / rate * seconds_per_minute) : std::nullopt;
}

double ProgrammedFeed::angular_rate() const {
    return angular_rate_ * times_per_minute().value_or(0.0);
}

std::optional<double> ProgrammedFeed::angular_speed() const {
    const double found = angular_rate();
    return found > 0.0 ? std::optional(from_degrees(found) / seconds_per_minute) : std::nullopt;
}

double ProgrammedFeed::rate() const {
    return a_revolution_ > 0.0 ? a_revolution_ * rpm_ : rate_ * times_per_minute().value_or(0.0);
}

std::optional<double> ProgrammedFeed::duration(double length) const {
    const double found = rate();
    return found > 0.0 ? std::optional(length / found * seconds_per_minute) : std::nullopt;
}

std::optional<double> ProgrammedFeed::speed() const {
    const double found = rate();
    return found > 0.0 ? std::optional(found / seconds_per_minute) : std::nullopt;
}

} // namespace millwright::gcode
