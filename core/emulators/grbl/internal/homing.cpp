#include "core/emulators/grbl/internal/homing.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace millwright::emulators::internal {

namespace {

constexpr int direction_mask = 23;
constexpr int locate_rate = 24;
constexpr int search_rate = 25;
constexpr int debounce_ms = 26;
constexpr int pull_off = 27;
constexpr int travel = 130;

} // namespace

Homing::Homing(const Eeprom& eeprom, const Axes& begin, bool switches_broken)
    : position_(begin), planned_(begin), failed_(switches_broken) {
    const auto mask = static_cast<unsigned>(eeprom.setting(direction_mask));
    const double off = eeprom.setting(pull_off);
    for (const std::initializer_list<unsigned> axes : {std::initializer_list<unsigned>{2U}, {0U, 1U}}) {
        Axes on = planned_;
        Axes clear = planned_;
        for (const unsigned axis : axes) {
            const bool negative = ((mask >> axis) & 1U) != 0;
            const double length = eeprom.axis_setting(travel, axis);
            on[axis] = negative ? -length : 0.0;
            clear[axis] = on[axis] + (negative ? off : -off);
        }
        add_leg(on, eeprom.setting(search_rate));
        if (switches_broken) {
            break;
        }
        add_leg(clear, eeprom.setting(search_rate));
        add_leg(on, eeprom.setting(locate_rate));
        add_leg(clear, eeprom.setting(search_rate));
        constexpr double seconds_per_ms = 1e-3;
        legs_.push_back({planned_, eeprom.setting(debounce_ms) * seconds_per_ms});
    }
    std::ranges::reverse(legs_);
}

void Homing::add_leg(const Axes& to, double rate_mm_per_min) {
    const double way = std::hypot(to[0] - planned_[0], to[1] - planned_[1], to[2] - planned_[2]);
    legs_.push_back({to, rate_mm_per_min > 0.0 ? way * seconds_per_minute / rate_mm_per_min : 0.0});
    planned_ = to;
}

double Homing::rest() const {
    double rest = 0.0;
    for (const Leg& leg : legs_) {
        rest += leg.seconds;
    }
    return rest;
}

void Homing::advance(double seconds) {
    while (!legs_.empty()) {
        Leg& leg = legs_.back();
        if (leg.seconds > seconds) {
            const double part = seconds / leg.seconds;
            for (std::size_t n = 0; n < position_.size(); ++n) {
                position_[n] += (leg.to[n] - position_[n]) * part;
            }
            leg.seconds -= seconds;
            return;
        }
        seconds -= leg.seconds;
        position_ = leg.to;
        legs_.pop_back();
    }
}

} // namespace millwright::emulators::internal
