// Jogs: how far they may go, how fast, and how they end.
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/internal/card_numbers.h"
#include "core/pmac/driver/internal/pmac_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::pmac::internal {

namespace {

/// Counts of each motor at a share of its way.
std::vector<double> along(const std::vector<double>& from, const std::vector<double>& way, double share) {
    std::vector<double> there;
    for (std::size_t n = 0; n < from.size(); ++n) {
        there.push_back(from[n] + share * way[n]);
    }
    return there;
}

} // namespace

/// While others are jogged on, an axis whose key is up brakes.
void PmacSession::let_go_of(std::size_t n) {
    MotorState& motor = motors_[n];
    if (std::abs(motor.target - motor.counts) > 1.0) {
        ask(fmt::format("#{}J/", settings_.axes[n].motor));
        motor.target = motor.counts;
    }
}

void PmacSession::jog_axis(std::size_t n, double target, double speed_deg_per_s) {
    const PmacAxis& axis = settings_.axes[n];
    motors_[n].target = std::round(target);
    set_jog_speed(n, most_jog_speed(n) * std::min(1.0, speed_deg_per_s / axis.jog_deg_per_s));
    ask(fmt::format("#{}J={:.0f}", axis.motor, motors_[n].target));
}

/// Why the motors may not be jogged to `targets`, counts, from `from`; "" if they may.
std::string PmacSession::leaves_limits(const std::vector<double>& from,
                                       const std::vector<double>& targets) const {
    if (!position_known()) {
        return {};
    }
    std::vector<double> targets_deg;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const PmacAxis& axis = settings_.axes[n];
        const double start = from[n] / axis.counts_per_degree;
        const double target = targets[n] / axis.counts_per_degree;
        if (target > std::max(axis.max_deg.value_or(target), start) ||
            target < std::min(axis.min_deg.value_or(target), start)) {
            return fmt::format("{} would exceed its limits, at {:.2f} degrees", name_of(n), target);
        }
        targets_deg.push_back(target);
    }
    return leaves_zone(settings_, axes_deg(), targets_deg, 0.0);
}

/// The share of a jog that ends inside of all limits, where the whole of it does not.
double PmacSession::share_within(const std::vector<double>& from, const std::vector<double>& way) const {
    constexpr int halvings = 12;
    double inside = 0.0, outside = 1.0;
    for (int n = 0; n < halvings; ++n) {
        const double middle = 0.5 * (inside + outside);
        (leaves_limits(from, along(from, way, middle)).empty() ? inside : outside) = middle;
    }
    return inside;
}

/// counts/ms
double PmacSession::most_jog_speed(std::size_t n) const {
    constexpr double per_ms = 1000.0;
    return settings_.axes[n].jog_deg_per_s * settings_.axes[n].counts_per_degree / per_ms;
}

/// For a jog; it is the card's own again when everything is at rest.
void PmacSession::set_jog_speed(std::size_t n, double counts_per_ms) {
    constexpr double least = 1e-6; // what is written; a motor at 0 would be on its way for ever
    if (!own_jog_speeds_[n]) {
        own_jog_speeds_[n] = readings_.jog_speed(n);
    }
    const double speed = std::max(counts_per_ms, least);
    ask(fmt::format("I{}22={:.6f}", settings_.axes[n].motor, speed));
    readings_.set_jog_speed(n, speed);
}

/// Before a jog that a person typed: none is faster than those by hand. `jog_speeds`: Ix22 of each axis.
void PmacSession::slow_down(const std::vector<std::string>& jog_speeds) {
    for (std::size_t n = motors_.size(); n-- > 0;) { // each before what stands in the queue
        const auto own = n < jog_speeds.size() ? card_number(jog_speeds[n]) : std::nullopt;
        if (own && *own > most_jog_speed(n)) {
            own_jog_speeds_[n] = own_jog_speeds_[n].value_or(*own);
            queue_.push_front(
                {fmt::format("I{}22={:.6f}", settings_.axes[n].motor, most_jog_speed(n)), Kind::watch, 0});
        }
    }
}

void PmacSession::give_jog_speeds_back() {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (const auto own = std::exchange(own_jog_speeds_[n], std::nullopt)) {
            ask(fmt::format("I{}22={:.6f}", settings_.axes[n].motor, *own), Kind::watch);
            readings_.set_jog_speed(n, *own);
        }
    }
}

void PmacSession::jog(const drivers::Jog& jog, double now) {
    if (stage_ != Stage::jogging || jogging_.stopping) {
        require_rest("a jog");
    }
    require_enabled("a jog");
    double longest = 0.0;
    for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
        if (!std::isfinite(jog.way[n]) || (n >= std::ssize(motors_) && std::abs(jog.way[n]) > 0.0)) {
            throw Error("this PMAC does not have this axis");
        }
        longest = std::max(longest, std::abs(jog.way[n]));
    }
    if (!(longest > 0.0) || !(jog.speed > 0.0)) {
        throw Error("a jog needs a distance and a speed");
    }
    const bool held = jog.dead_man > 0.0;
    const bool goes_on = stage_ == Stage::jogging;
    double slower = 1.0; // of all axes, so that the way keeps its direction
    for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
        const double speed = to_degrees(jog.speed) * std::abs(jog.way[n]) / longest;
        if (speed > 0.0) {
            slower = std::min(slower, settings_.axes[static_cast<std::size_t>(n)].jog_deg_per_s / speed);
        }
    }
    std::vector<double> from, way;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const auto axis = static_cast<Eigen::Index>(n);
        const double angle = axis < jog.way.size() ? to_degrees(jog.way[axis]) : 0.0;
        from.push_back(goes_on && !held ? motors_[n].target : motors_[n].counts);
        way.push_back(angle * settings_.axes[n].counts_per_degree * (held ? slower : 1.0));
    }
    double share = 1.0;
    if (const std::string why = leaves_limits(from, along(from, way, share)); !why.empty()) {
        constexpr double least_deg = 0.05; // of what is worth a move
        share = held ? share_within(from, way) : 0.0;
        if (share * slower * to_degrees(longest) < least_deg) {
            throw Error(why);
        }
    }
    if (!goes_on) {
        arm();
    }
    const std::vector<double> targets = along(from, way, share);
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (std::abs(way[n]) > 0.0) {
            const double speed =
                to_degrees(jog.speed) * std::abs(jog.way[static_cast<Eigen::Index>(n)]) / longest;
            jog_axis(n, targets[n], slower * speed);
        } else if (goes_on && held) {
            let_go_of(n);
        } else {
            motors_[n].target = targets[n];
        }
    }
    if (stage_ != Stage::jogging) {
        finish(Stage::jogging);
    }
    jogging_.until = held ? std::optional(now + jog.dead_man) : std::nullopt;
    quiet_polls_ = 0;
}

void PmacSession::stop_jog(double /*now*/) {
    halt_jog();
}

void PmacSession::halt_jog() {
    if (stage_ != Stage::jogging || jogging_.stopping) {
        return;
    }
    forget_queue();
    if (enabled()) {
        ask(every_motor("J/"));
    } else {
        kill();
    }
    jogging_.stopping = true;
    jogging_.until.reset();
    quiet_polls_ = 0;
}

} // namespace millwright::pmac::internal
