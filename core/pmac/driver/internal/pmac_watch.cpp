// What a round of answers says, and what follows from it.
#include "core/arm/arm_model.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/internal/card_numbers.h"
#include "core/pmac/driver/internal/pmac_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace millwright::pmac::internal {

namespace {

constexpr std::size_t status_digits = 12;

struct Words {
    std::uint32_t first = 0, second = 0;
};

std::optional<Words> status_words(std::string_view text) {
    constexpr int hexadecimal = 16;
    constexpr std::size_t half = 6;
    Words words;
    if (text.size() != status_digits) {
        return std::nullopt;
    }
    const auto a = std::from_chars(text.data(), text.data() + half, words.first, hexadecimal);
    const auto b = std::from_chars(text.data() + half, text.data() + text.size(), words.second, hexadecimal);
    const bool whole = a.ec == std::errc{} && b.ec == std::errc{} && a.ptr == text.data() + half &&
                       b.ptr == text.data() + text.size();
    return whole ? std::optional(words) : std::nullopt;
}

} // namespace

void PmacSession::read_poll(const std::vector<std::string>& lines, double now) {
    const std::size_t of_motors = 2 * motors_.size();
    const auto system = lines.size() == of_motors + 3 ? status_words(lines[of_motors]) : std::nullopt;
    const auto mark = system ? card_number(lines[of_motors + 1]) : std::nullopt;
    const auto guard = system ? card_number(lines[of_motors + 2]) : std::nullopt;
    if (!mark || !guard) {
        fail("the card's status report is not in the expected format");
        return;
    }
    const double since = now - polled_at_;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const auto words = status_words(lines[2 * n]);
        const auto counts = card_number(lines[2 * n + 1]);
        if (!words || !counts) {
            fail("the card's motor report is not in the expected format");
            return;
        }
        MotorState& motor = motors_[n];
        const bool was_home = motor.home();
        motor.speed = polled_ && since > 0.0 ? (*counts - motor.counts) / since : 0.0;
        motor.counts = *counts;
        motor.word_1 = words->first;
        motor.word_2 = words->second;
        const bool zeroed = motor.home() != was_home; // its counts begin anew
        if (!polled_ || zeroed || (motor.standing() && exactly_equal(motor.speed, 0.0))) {
            motor.shown_speed.stand(*counts, now);
        } else {
            motor.shown_speed.see(*counts, now);
        }
        motor.had_power = motor.had_power || motor.enabled();
        motor.lag_is_old = (!polled_ || motor.lag_is_old) && motor.left_behind() && !motor.enabled();
    }
    system_1_ = system->first;
    system_2_ = system->second;
    mark_ = *mark;
    guard_.see(*guard, watchdog_.armed);
    if (stage_ == Stage::alarm && !guard_.runs() && guard_.is_disarmed() && !any_power()) {
        watchdog_.armed = false; // it has taken the power while we were not heard, which disarms it
    }
    polled_ = true;
    unseen_ = false;
    polled_at_ = now;
    power_.found = power_.found && any_power();
    watch(now);
}

bool PmacSession::position_known() const {
    return polled_ &&
           std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.home(); });
}

bool PmacSession::enabled() const {
    return polled_ &&
           std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.enabled(); });
}

void PmacSession::watch(double now) {
    if (stage_ == Stage::greeting) {
        finish(Stage::ready);
        was_home_ = position_known();
        power_.found = any_power();
        return;
    }
    if (stage_ == Stage::parting) {
        watch_parting();
        return;
    }
    if (stage_ == Stage::alarm) {
        if (any_power()) {
            kill(); // what was sent may have been lost
        }
        watch_killed();
        return;
    }
    watch_motors();
    watch_own_stop();
    watch_power();
    watch_guard();
    watch_following(now);
    watch_limits();
    watch_rest();
    if (stage_ == Stage::homing) {
        watch_way_home();
    }
    watch_stage();
}

void PmacSession::watch_motors() {
    const bool watched =
        active() || stage_ == Stage::moving_by_command || stage_ == Stage::commanding || rests();
    const bool need_power = stage_ == Stage::running || stage_ == Stage::homing || stage_ == Stage::jogging;
    const auto killed =
        std::find_if(motors_.begin(), motors_.end(), [](const MotorState& m) { return !m.enabled(); });
    if (watched && killed != motors_.end()) {
        // A card that kills one motor may kill all of them: what one of them tells is the reason for all.
        if (const std::string why = reason_of_kill(true); !why.empty()) {
            fail(why);
        } else if (need_power) {
            const int motor = settings_.axes[static_cast<std::size_t>(killed - motors_.begin())].motor;
            fail(fmt::format("motor {} was killed", motor) + (unheard().empty() ? "" : ": " + unheard()));
            unexplained_ = unheard().empty();
        }
    }
    const bool forgot = was_home_ && !position_known() && stage_ != Stage::homing &&
                        stage_ != Stage::commanding && stage_ != Stage::moving_by_command;
    if (forgot) {
        fail("the card lost the position: check whether it was reset");
    }
    was_home_ = position_known();
}

/// What the guard in the card ended of a typed line, or of power that was there: else it would be gone
/// without a word. Jogs, homing and programs tell it by themselves.
void PmacSession::watch_own_stop() {
    if (!watchdog_.armed || !watchdog_.mark_is_ours || unheard().empty()) {
        return;
    }
    const bool commands = stage_ == Stage::moving_by_command || stage_ == Stage::commanding;
    const bool lost_power = std::ranges::any_of(motors_, [](const MotorState& motor) {
        return (motor.had_power || motor.was_given_power) && !motor.enabled();
    });
    if ((commands || rests()) && lost_power) {
        fail("the card disabled its motors: " + unheard());
    } else if (stage_ == Stage::moving_by_command && !command_.only_sets && any_power()) {
        const std::string why = unheard();
        halt();
        message_ = "the card stopped its motors: " + why;
    }
}

/// Empty where no motor without power tells any.
std::string PmacSession::reason_of_kill(bool now) const {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const MotorState& motor = motors_[n];
        if (now && !motor.had_power && !command_.closes_loops) {
            continue;
        }
        if (motor.faulty() && !motor.enabled()) {
            return fmt::format("motor {}: its amplifier reports a fault", settings_.axes[n].motor);
        }
        if (motor.left_behind() && !motor.enabled() && !motor.lag_is_old) {
            return fmt::format("motor {}: its following error exceeded the limit", settings_.axes[n].motor);
        }
    }
    return {};
}

/// A report tells of one motor after the other: the reason may stand in the next one only.
void PmacSession::watch_killed() {
    if (!unexplained_) {
        return;
    }
    if (std::string why = reason_of_kill(false); !why.empty()) {
        unexplained_ = false;
        tell(false, drivers::ConsoleKind::fault, why);
        message_ = std::move(why);
    }
}

/// Motors that take no power say nothing of it.
void PmacSession::watch_power() {
    if (power_polls_ == 0 || !queue_.empty()) {
        return;
    }
    power_polls_ = enabled() || !rests() ? 0 : power_polls_ - 1;
    if (power_polls_ > 0 || enabled() || !rests()) {
        return;
    }
    const std::string why = reason_of_kill(false);
    const auto without =
        std::find_if(motors_.begin(), motors_.end(), [](const MotorState& m) { return !m.enabled(); });
    fail(!why.empty()
             ? why + ", and it cannot be enabled"
             : fmt::format("motor {} cannot be enabled",
                           settings_.axes[static_cast<std::size_t>(without - motors_.begin())].motor));
}

/// Without it a link that is lost leaves the motors running.
void PmacSession::watch_guard() {
    if (!guard_.runs() && any_power()) {
        fail(guard_is_off);
    }
}

/// By what the card last reported of the following errors, if that was just now.
void PmacSession::watch_following(double now) {
    constexpr double fresh = 0.3; // s
    const std::vector<drivers::MotorReading>& readings = readings_.motors();
    const bool moves = (active() && stage_ != Stage::loading) || stage_ == Stage::moving_by_command;
    if (!moves || readings.size() != motors_.size() || now - read_at_ > fresh) {
        following_.forget();
        return;
    }
    std::vector<double> lags;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        lags.push_back(motors_[n].enabled() ? to_degrees(readings[n].following_error) : 0.0);
    }
    if (const auto n = following_.left_behind(lags, axes_deg(), now)) {
        fail(fmt::format("{} is commanded {:.2f} degrees further but does not move: check that its amplifier "
                         "has power, the brake is released and the path is clear",
                         name_of(*n),
                         std::abs(lags[*n])));
    }
}

void PmacSession::watch_limits() {
    constexpr double slack_deg = 0.2;
    if (!(active() || stage_ == Stage::moving_by_command) || !position_known() || stage_ == Stage::homing ||
        stage_ == Stage::stopping) {
        watched_deg_.clear();
        return;
    }
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const PmacAxis& axis = settings_.axes[n];
        const double at = motors_[n].counts / axis.counts_per_degree;
        const bool out = (axis.max_deg && at > *axis.max_deg + slack_deg && motors_[n].speed > 0.0) ||
                         (axis.min_deg && at < *axis.min_deg - slack_deg && motors_[n].speed < 0.0);
        if (out) {
            halt();
            message_ = fmt::format("{} is beyond its limit, at {:.2f} degrees", name_of(n), at);
            return;
        }
    }
    watch_zone();
}

/// Of the arm whose joints the axes are: which limits it has beside theirs.
void PmacSession::watch_zone() {
    constexpr double slack_mm = 1.0; // noise of the encoders at the end of a long arm
    const std::vector<double> before = std::exchange(watched_deg_, axes_deg());
    if (before.size() != watched_deg_.size()) {
        return; // the first look
    }
    if (const std::string why = leaves_zone(settings_, before, watched_deg_, slack_mm); !why.empty()) {
        halt();
        message_ = "stopped at the limit of the arm's workspace: " + why;
    }
}

/// With a wrong gain or offset a motor goes where it was not sent, and brakes do not hold it.
void PmacSession::watch_rest() {
    constexpr double slack_deg = 2.0;
    const bool only_set =
        command_.only_sets && (stage_ == Stage::commanding || stage_ == Stage::moving_by_command);
    if (!rests() && !only_set) {
        rest_counts_.clear();
        return;
    }
    const bool first = rest_counts_.empty();
    rest_counts_.resize(motors_.size());
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (first || !motors_[n].enabled()) {
            rest_counts_[n] = motors_[n].counts;
        } else if (std::abs(motors_[n].counts - rest_counts_[n]) >
                   slack_deg * settings_.axes[n].counts_per_degree) {
            fail(fmt::format("{} is enabled and moves without a command", name_of(n)));
            return;
        }
    }
}

std::string PmacSession::name_of(std::size_t axis) const {
    return settings_.arm ? "joint " + settings_.arm->joint(static_cast<int>(axis)).name
                         : std::string(1, settings_.axes[axis].letter);
}

std::vector<double> PmacSession::axes_deg() const {
    std::vector<double> degrees;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        degrees.push_back(motors_[n].counts / settings_.axes[n].counts_per_degree);
    }
    return degrees;
}

/// A flag that is not connected, or whose settings are wrong, must not let a motor run for ever.
void PmacSession::watch_way_home() {
    constexpr double slack_deg = 20.0, turn_deg = 360.0;
    const PmacAxis& axis = settings_.axes[homing_.axis];
    const double range = axis.max_deg && axis.min_deg ? *axis.max_deg - *axis.min_deg : turn_deg;
    const double way = std::abs(motors_[homing_.axis].counts - homing_.from) / axis.counts_per_degree;
    if (way > range + slack_deg) {
        halt();
        message_ =
            fmt::format("motor {} moved {:.0f} degrees without finding its home: check its home flag and I{}",
                        axis.motor,
                        way,
                        902 + 5 * (axis.motor - 1));
    }
}

} // namespace millwright::pmac::internal
