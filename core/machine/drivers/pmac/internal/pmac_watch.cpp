// What a round of answers says, and what follows from it.
#include "core/machine/drivers/pmac/internal/card_numbers.h"
#include "core/machine/drivers/pmac/internal/pmac_session.h"
#include "core/machine/drivers/pmac/internal/watchdog.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace millwright::machine::pmac {

namespace {

constexpr std::size_t status_digits = 12;
constexpr int patience = 25; // polls: half a second

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
    const std::size_t expected = 2 + 2 * motors_.size();
    const auto system = lines.size() == expected ? status_words(lines[expected - 2]) : std::nullopt;
    const auto mark = system ? card_number(lines.back()) : std::nullopt;
    if (!mark) {
        fail("the card's report is not what was asked for");
        return;
    }
    const double since = now - polled_at_;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const auto words = status_words(lines[2 * n]);
        const auto counts = card_number(lines[2 * n + 1]);
        if (!words || !counts) {
            fail("the card's report of a motor is not what was asked for");
            return;
        }
        MotorState& motor = motors_[n];
        motor.speed = polled_ && since > 0.0 ? (*counts - motor.counts) / since : 0.0;
        motor.counts = *counts;
        motor.word_1 = words->first;
        motor.word_2 = words->second;
    }
    system_1_ = system->first;
    system_2_ = system->second;
    mark_ = *mark;
    polled_ = true;
    polled_at_ = now;
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
        return;
    }
    if (stage_ == Stage::alarm) {
        const bool powered =
            std::any_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.enabled(); });
        if (powered) {
            kill(); // what was sent may have been lost
        }
        return;
    }
    watch_motors();
    watch_limits(now);
    watch_stage();
}

void PmacSession::watch_motors() {
    constexpr std::uint32_t fatal = 1U << 2, fault = 1U << 3;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const MotorState& motor = motors_[n];
        const std::string name = fmt::format("motor {}", settings_.axes[n].motor);
        if (active() && (motor.word_2 & fault) != 0 && !motor.enabled()) {
            fail(name + ": its amplifier reports a fault");
        } else if (active() && (motor.word_2 & fatal) != 0 && !motor.enabled()) {
            fail(name + ": its following error became too great");
        } else if ((stage_ == Stage::running || stage_ == Stage::homing || stage_ == Stage::jogging) &&
                   !motor.enabled()) {
            fail(name + " was killed");
        }
    }
    const bool forgot =
        was_home_ && !position_known() && stage_ != Stage::homing && stage_ != Stage::commanding;
    if (forgot) {
        fail("the card forgot the position: was it reset?");
    }
    was_home_ = position_known();
}

void PmacSession::watch_limits(double now) {
    constexpr double slack_deg = 0.2;
    if (!active() || !position_known() || stage_ == Stage::homing || stage_ == Stage::stopping) {
        return;
    }
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const PmacAxis& axis = settings_.axes[n];
        const double at = motors_[n].counts / axis.counts_per_degree;
        const bool out = (axis.max_deg && at > *axis.max_deg + slack_deg && motors_[n].speed > 0.0) ||
                         (axis.min_deg && at < *axis.min_deg - slack_deg && motors_[n].speed < 0.0);
        if (out) {
            stop(now);
            message_ = fmt::format("{} is beyond its limit, at {:.2f} degrees", axis.letter, at);
            return;
        }
    }
}

bool PmacSession::standing() const {
    constexpr std::uint32_t running_bit = 1;
    return (system_1_ & running_bit) == 0 &&
           std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.standing(); });
}

void PmacSession::watch_stage() {
    const bool in_place =
        std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.in_place(); });
    astray_polls_ = standing() && !in_place ? astray_polls_ + 1 : 0;
    if (astray_polls_ > patience) {
        fail("a motor with power is not where it was sent");
        return;
    }
    quiet_polls_ = standing() && in_place && queue_.empty() ? quiet_polls_ + 1 : 0;
    const bool settled = quiet_polls_ >= 2; // the first may have been asked before a command arrived
    switch (stage_) {
    case Stage::running:
        watch_program(settled);
        break;
    case Stage::jogging:
        if (settled && (!jog_until_ || jog_stopping_)) {
            finish(jog_stopping_ ? Stage::stopped : Stage::ready);
        }
        break;
    case Stage::homing:
        if (settled) {
            watch_homing();
        }
        break;
    case Stage::stopping:
        watch_stopping();
        break;
    case Stage::ready:
    case Stage::stopped:
        if (settled && armed_) {
            rest();
        }
        break;
    default:
        break;
    }
}

/// Nothing moves: the card need not watch, and no character that was garbled into ^R finds a program.
void PmacSession::rest() {
    ask(disarm_watchdog);
    ask(fmt::format("&{}B0", settings_.system));
    armed_ = false;
}

void PmacSession::watch_program(bool settled) {
    constexpr std::uint32_t errors = 3U << 21, at_limit = 1U << 11, held_bit = 1U << 23;
    constexpr int ahead = 4; // a program is calculated before its moves are made
    if (marks_tell_) {
        executed_ = std::clamp(static_cast<int>(std::min(mark_, 1e6)) - ahead, executed_, program_lines_);
    }
    const bool all_sent = queue_.empty(); // else the report may be older than our resume
    if ((system_2_ & held_bit) != 0 && !held_ && all_sent) {
        held_ = true;
        message_ = "held, and nobody here asked for it";
    }
    if ((system_2_ & errors) != 0) {
        fail("the card ended the program with a run-time error");
    } else if (settled && mark_ > program_lines_ + 0.5) {
        executed_ = program_lines_;
        finish(Stage::ready);
    } else if (settled) {
        const bool limit = std::any_of(
            motors_.begin(), motors_.end(), [](const MotorState& m) { return (m.word_2 & at_limit) != 0; });
        fail(limit ? "a motor ran into a limit" : "the program was ended by somebody else");
    }
}

void PmacSession::watch_homing() {
    const bool found = motors_[homing_axis_].home();
    if (!found && quiet_polls_ <= patience) {
        return; // it stands for a moment where it turns back to its flag
    }
    if (!found) {
        fail(fmt::format("motor {} did not find its home flag", settings_.axes[homing_axis_].motor));
    } else if (++homing_axis_ < motors_.size()) {
        ask(fmt::format("#{}HM", settings_.axes[homing_axis_].motor));
        quiet_polls_ = 0;
    } else {
        finish(Stage::ready);
    }
}

void PmacSession::watch_stopping() {
    constexpr std::uint32_t held_bit = 1U << 23;
    if ((system_2_ & held_bit) != 0 && queue_.empty()) {
        // at rest: an abort forgets the program; it would close open loops, so all have to be closed
        if (enabled()) {
            ask(fmt::format("&{}A", settings_.system));
        } else {
            kill();
        }
    } else if (quiet_polls_ >= 2 && armed_) {
        rest();
    } else if (quiet_polls_ >= 2) {
        finish(Stage::stopped, message_);
    }
}

/// Ends whatever is going on: in a state without motion, or on the way there.
void PmacSession::finish(Stage stage, std::string why) {
    stage_ = stage;
    message_ = std::move(why);
    jog_until_.reset();
    jog_stopping_ = held_ = false;
    quiet_polls_ = astray_polls_ = 0;
    if (answer_.state == CommandAnswer::State::pending && stage != Stage::commanding) {
        answer_.state = CommandAnswer::State::refused;
        answer_.text = message_.empty() ? "stopped" : message_;
    }
}

/// The state is not known, or wrong: nothing may have power.
void PmacSession::fail(std::string why) {
    if (stage_ == Stage::alarm) {
        return;
    }
    (void)
        talk_.take_output(); // a line on its way must not arrive behind the kill: a jog would give power back
    talk_.forget();
    sent_.reset();
    output_ = "\x18";
    kill();
    queue_.clear();
    command_lines_.clear();
    buffer_open_ = false;
    finish(Stage::alarm, std::move(why));
    ask("CLOSE");
}

/// The one command that nothing refuses; three times, since a character may be lost.
void PmacSession::kill() {
    output_ += "\x0B\x0B\x0B";
}

} // namespace millwright::machine::pmac
