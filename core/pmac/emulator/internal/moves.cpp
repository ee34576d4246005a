// How a statement with axes becomes a move with its time.
#include "core/base/units.h"
#include "core/pmac/emulator/internal/card.h"
#include "core/pmac/emulator/internal/coordinate_system.h"

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr double per_ms = 1000.0;

Vec3 tip(const Axes& axes) {
    return {axes[0], axes[1], axes[2]};
}

} // namespace

CoordinateSystem::Next CoordinateSystem::move(const Statement& statement) {
    if (!path_.room() || dwelling() || homing_ != 0) {
        gave_up_blending_ = false;
        return Next::wait;
    }
    ++at_.statement;
    Move made;
    made.from = made.to = target_;
    if (statement.verb == Verb::delay) {
        made.ramp = program_ramp();
        made.time = std::max(statement.data.value(*card_) / per_ms, made.ramp.time);
        if (!is_segmented()) {
            keep_to_limits(made);
        }
        add(made);
        return calculating() ? Next::go_on : Next::end;
    }
    for (const Statement::AxisWord& word : statement.words) {
        const std::size_t axis = axis_letters.find(word.letter);
        if (axis != std::string_view::npos) {
            const double value = word.data.value(*card_);
            made.to[axis] = incremental_[axis] ? made.to[axis] + value : value + place_offset_[axis];
        }
    }
    const bool circle = mode_ == Mode::clockwise || mode_ == Mode::counter_clockwise;
    if (circle && is_segmented() && !shape_arc(statement, made)) {
        run_error_ = RunError::radius;
        fail();
        return Next::end;
    }
    mode_ == Mode::rapid ? time_rapid(made) : time_move(made);
    add(made);
    return calculating() ? Next::go_on : Next::end;
}

void CoordinateSystem::add(Move made) {
    target_ = made.to;
    gave_up_blending_ = false;
    constexpr int no_blending = 92;
    made.blends = made.blends && !stepping_ && !(i(no_blending) > 0.0);
    path_.add(made);
    for (int n = 0; n < motors; ++n) {
        speeds_[static_cast<std::size_t>(n)] = motor_way(made, n) / made.time;
    }
    ++moves_;
    if (stepping_ && !in_block_) {
        calculation_ = Calculation::stopped;
    }
}

Ramp CoordinateSystem::program_ramp() const {
    constexpr int time = 87, s_curve = 88;
    const double s = s_curve_.value_or(i(s_curve)) / per_ms;
    const double t = ramp_time_.value_or(i(time)) / per_ms;
    constexpr double least = 1e-3; // TA and TS may not both be 0
    return {std::max({t, 2.0 * s, least}), s};
}

/// Circles are possible, and Ix16 and Ix17 are not looked at.
bool CoordinateSystem::is_segmented() const {
    constexpr int segmentation = 13;
    return card_->i(segmentation) > 0.0;
}

/// Counts that a move takes a motor, signed.
double CoordinateSystem::motor_way(const Move& move, int motor) const {
    double way = 0.0;
    for (std::size_t n = 0; n < move.to.size(); ++n) {
        way += definition(motor).factors[n] * (move.to[n] - move.from[n]);
    }
    return way;
}

/// Counts/s at which the move that this one is blended with takes a motor.
double CoordinateSystem::speed_before(int motor) const {
    return path_.blends_on() ? speeds_[static_cast<std::size_t>(motor)] : 0.0;
}

/// The time that a motor needs at its rate (Ix17) to come from the speed of the move before to that of this
/// one, which takes `time`; with the S-curve's, s.
double CoordinateSystem::change_time(const Move& move, int motor, double time) const {
    constexpr int hundred = 100, most_acceleration = 17;
    const double rate = card_->i(hundred * (motor + 1) + most_acceleration) * per_ms * per_ms;
    const double change = std::abs(motor_way(move, motor) / time - speed_before(motor));
    return rate > 0.0 && change > 0.0 ? move.ramp.s_curve + change / rate : 0.0;
}

/// Takes as much time as Ix16 and Ix17 ask for; a slower move also changes the speed less.
void CoordinateSystem::keep_to_limits(Move& made) const {
    constexpr int hundred = 100, most_speed = 16;
    for (int n = 0; n < motors; ++n) {
        const double speed = card_->i(hundred * (n + 1) + most_speed) * per_ms;
        made.time = speed > 0.0 ? std::max(made.time, std::abs(motor_way(made, n)) / speed) : made.time;
    }
    const auto ramp_time = [&](double time) {
        double needed = made.ramp.time;
        for (int n = 0; n < motors; ++n) {
            needed = std::max(needed, change_time(made, n, time));
        }
        return needed;
    };
    double low = made.time, high = made.time;
    while (ramp_time(high) > high) { // step by step: too slow a move would have to brake for longer again
        constexpr double little = 1.01;
        low = high;
        high *= little;
    }
    if (high > low) {
        constexpr int halvings = 40;
        for (int n = 0; n < halvings; ++n) {
            const double middle = 0.5 * (low + high);
            (ramp_time(middle) > middle ? low : high) = middle;
        }
        made.time = high;
    }
    made.stop = made.ramp;
    made.ramp.time = ramp_time(made.time);
    made.stop->time = stop_time(made);
}

/// How long it brakes if none follows it. The card looks no farther ahead than this move, so that it brakes
/// harder than Ix17 where the move is too short for that.
double CoordinateSystem::stop_time(const Move& made) const {
    double needed = made.stop->time;
    for (int n = 0; n < motors; ++n) {
        constexpr int hundred = 100, most_acceleration = 17;
        const double rate = card_->i(hundred * (n + 1) + most_acceleration) * per_ms * per_ms;
        const double speed = std::abs(motor_way(made, n)) / made.time;
        needed = rate > 0.0 && speed > 0.0 ? std::max(needed, made.ramp.s_curve + speed / rate) : needed;
    }
    return std::min(needed, 2.0 * made.time - made.ramp.time);
}

void CoordinateSystem::time_move(Move& made) const {
    made.ramp = program_ramp();
    double length = 0.0;
    for (std::size_t n = 0; n < made.to.size(); ++n) {
        length += feeds_[n] && !(made.arc && n < 3) ? std::pow(made.to[n] - made.from[n], 2) : 0.0;
    }
    if (made.arc) {
        const Vec3 way = tip(made.to) - tip(made.from);
        const double radius = (tip(made.from) - made.arc->center).cross(made.arc->normal).norm();
        length += std::pow(radius * made.arc->angle, 2) + std::pow(way.dot(made.arc->normal), 2);
    }
    constexpr int default_feed = 89, time_unit = 90;
    const double feed = feed_.value_or(i(default_feed));
    const double time =
        time_ ? *time_ / per_ms : (feed > 0.0 ? std::sqrt(length) / feed : 0.0) * i(time_unit) / per_ms;
    made.time = std::max(time, made.ramp.time);
    if (!is_segmented()) {
        keep_to_limits(made);
    }
}

void CoordinateSystem::time_rapid(Move& made) const {
    made.blends = false;
    made.ramp = {1e-3, 0.0};
    for (int n = 0; n < motors; ++n) {
        const double way = std::abs(motor_way(made, n));
        if (way > 0.0) {
            const JogRules& rules = card_->settings(n).jog;
            const double speed = std::max(rules.speed, 1e-6);
            const Ramp ramp = rules.ramp(speed);
            made.time = std::max(made.time, way / speed);
            made.ramp = ramp.time > made.ramp.time ? ramp : made.ramp;
        }
    }
    made.time = std::max(made.time, made.ramp.time);
}

/// False: there is no such arc.
bool CoordinateSystem::shape_arc(const Statement& statement, Move& made) {
    std::optional<double> radius;
    std::optional<Vec3> told;
    for (const Statement::AxisWord& word : statement.words) {
        if (word.letter == 'R') {
            radius = word.data.value(*card_);
        } else if (word.letter >= 'I' && word.letter <= 'K') {
            told = told.value_or(Vec3::Zero());
            (*told)[word.letter - 'I'] = word.data.value(*card_);
        }
    }
    const Vec3 normal = mode_ == Mode::clockwise ? normal_ : Vec3(-normal_);
    const Vec3 from = tip(made.from);
    const Vec3 across = (tip(made.to) - from) - (tip(made.to) - from).dot(normal) * normal;
    Arc arc{.center = from, .normal = normal, .angle = 0.0, .last_radius = 0.0};
    if (radius) {
        const double half = 0.5 * across.norm();
        const double room = *radius * *radius - half * half;
        constexpr double slack = 1e-9;
        if (!(half > 0.0) || room < -slack * half * half) {
            return false;
        }
        const Vec3 side = normal.cross(across).normalized();
        arc.center = from + 0.5 * across + std::copysign(std::sqrt(std::max(0.0, room)), *radius) * side;
    } else if (told) {
        const Vec3 vector = center_ == CenterMode::absolute ? Vec3(*told - from) : *told;
        arc.center = from + (vector - vector.dot(normal) * normal);
    } else {
        return false;
    }
    const Vec3 first = from - arc.center;
    const Vec3 last = from + across - arc.center;
    const double a = first.norm(), b = last.norm();
    constexpr int tolerance = 96;
    const double allowed = i(tolerance) > 0.0 ? i(tolerance) : 0.01 * a;
    if (!(a > 0.0) || !(b > 0.0) || std::abs(a - b) > allowed) {
        return false;
    }
    constexpr double same = 1e-9;
    const double angle = std::atan2(first.cross(last).dot(normal), first.dot(last));
    arc.angle = angle > same || (radius && angle > 0.0) ? angle : angle + 2.0 * pi;
    arc.last_radius = b;
    made.arc = arc;
    return true;
}

} // namespace millwright::pmac::card
