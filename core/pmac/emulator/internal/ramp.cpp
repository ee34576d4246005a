#include "core/pmac/emulator/internal/ramp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::pmac::card {

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double shortest_time = 1e-4; // s; Ix20 = Ix21 = 0 has no acceleration to divide by

double way_of(const std::vector<Profile::Part>& parts) {
    double way = 0.0;
    for (const Profile::Part& part : parts) {
        way += 0.5 * (part.from + part.to) * part.ramp.time + part.to * part.cruise;
    }
    return way;
}

std::vector<Profile::Part> up_and_down(double velocity, double peak, double cruise, const JogRules& rules) {
    return {{rules.ramp(peak - velocity), velocity, peak, cruise}, {rules.ramp(peak), peak, 0.0, 0.0}};
}

} // namespace

double Ramp::speed(double t) const {
    if (t <= 0.0 || t >= time) {
        return t <= 0.0 ? 0.0 : 1.0;
    }
    if (t > 0.5 * time) {
        return 1.0 - speed(time - t);
    }
    return t < s_curve ? 0.5 * peak() * t * t / s_curve : peak() * (t - 0.5 * s_curve);
}

double Ramp::way(double t) const {
    if (t <= 0.0) {
        return 0.0;
    }
    if (t >= time) {
        return 0.5 * time + (t - time);
    }
    if (t > 0.5 * time) {
        return (t - 0.5 * time) + way(time - t);
    }
    if (t < s_curve) {
        return peak() * t * t * t / (6.0 * s_curve);
    }
    const double past = t - s_curve;
    return peak() * (s_curve * s_curve / 6.0 + 0.5 * past * past + 0.5 * s_curve * past);
}

Ramp JogRules::ramp(double change) const {
    const double least = std::max({acceleration_time, 2.0 * s_curve_time, shortest_time});
    const double limited = s_curve_time + std::abs(change) / acceleration;
    return {std::max(least, limited), s_curve_time};
}

void Profile::begin(double position, double velocity, std::vector<Part> parts) {
    parts_ = std::move(parts);
    part_ = 0;
    time_ = 0.0;
    base_ = position_ = position;
    velocity_ = parts_.empty() ? 0.0 : velocity;
}

void Profile::advance(double seconds) {
    time_ += seconds;
    while (!done()) {
        const Part& part = parts_[part_];
        if (time_ < part.ramp.time + part.cruise) {
            const double change = part.to - part.from;
            position_ = base_ + part.from * time_ + change * part.ramp.way(time_);
            velocity_ = part.from + change * part.ramp.speed(time_);
            return;
        }
        base_ += 0.5 * (part.from + part.to) * part.ramp.time + part.to * part.cruise;
        time_ -= part.ramp.time + part.cruise;
        position_ = base_;
        velocity_ = part.to;
        ++part_;
    }
    velocity_ = 0.0;
}

std::vector<Profile::Part> to_speed(double velocity, double speed, const JogRules& rules) {
    return {{rules.ramp(speed - velocity), velocity, speed, forever}};
}

std::vector<Profile::Part> to_rest(double velocity, const JogRules& rules) {
    if (!(std::abs(velocity) > 0.0)) {
        return {};
    }
    return {{rules.ramp(velocity), velocity, 0.0, 0.0}};
}

std::vector<Profile::Part> by_way(double velocity, double way, const JogRules& rules) {
    const double sign = way < 0.0 ? -1.0 : 1.0;
    const std::vector<Profile::Part> stop = to_rest(velocity, rules);
    constexpr double at_rest = 1e-9;
    const bool rests = std::abs(velocity) < at_rest;
    const bool turns =
        velocity * sign < 0.0 || sign * (way - way_of(up_and_down(velocity, velocity, 0.0, rules))) < 0.0;
    if (!rests && turns) {
        std::vector<Profile::Part> parts = stop; // and back, if need be
        for (const Profile::Part& part : by_way(0.0, way - way_of(stop), rules)) {
            parts.push_back(part);
        }
        return parts;
    }
    const double top = sign * std::max(rules.speed, 1e-9);
    const double left = sign * (way - way_of(up_and_down(velocity, top, 0.0, rules)));
    if (left >= 0.0) {
        return up_and_down(velocity, top, left / std::abs(top), rules);
    }
    double low = 0.0, high = 1.0; // of the way from the velocity it has (or rest) to the top
    constexpr int halvings = 60;
    for (int n = 0; n < halvings; ++n) {
        const double middle = 0.5 * (low + high);
        const double peak = velocity + middle * (top - velocity);
        (sign * way_of(up_and_down(velocity, peak, 0.0, rules)) < sign * way ? low : high) = middle;
    }
    const double peak = velocity + low * (top - velocity);
    const double rest = sign * (way - way_of(up_and_down(velocity, peak, 0.0, rules)));
    const double cruise = std::abs(peak) > at_rest ? std::max(0.0, rest) / std::abs(peak) : 0.0;
    return up_and_down(velocity, peak, cruise, rules);
}

std::vector<Profile::Part> braking(double velocity, double deceleration) {
    return {{{std::abs(velocity) / deceleration, 0.0}, velocity, 0.0, 0.0}};
}

} // namespace millwright::pmac::card
