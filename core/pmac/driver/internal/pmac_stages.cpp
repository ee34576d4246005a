// How what is under way goes on, and ends: by the last round of answers.
#include "core/base/units.h"
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/driver/internal/watchdog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::pmac::internal {

bool PmacSession::standing() const {
    constexpr std::uint32_t running_bit = 1;
    return (system_1_ & running_bit) == 0 &&
           std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.standing(); });
}

void PmacSession::watch_stage() {
    const bool in_place =
        std::all_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.in_place(); });
    off_target_polls_ = standing() && !in_place ? off_target_polls_ + 1 : 0;
    if (off_target_polls_ > patient_polls) {
        fail(off_target_sentence());
        return;
    }
    quiet_polls_ = standing() && in_place && queue_.empty() ? quiet_polls_ + 1 : 0;
    const bool settled = quiet_polls_ >= 2; // the first may have been asked before a command arrived
    switch (stage_) {
    case Stage::running:
        watch_program(settled);
        break;
    case Stage::jogging:
        if (settled && (!jogging_.until || jogging_.stopping)) {
            finish(jogging_.stopping ? Stage::stopped : Stage::ready);
        }
        break;
    case Stage::homing:
        if (settled) {
            watch_homing();
        }
        break;
    case Stage::stopping:
        braking_.due ? brake() : watch_stopping();
        break;
    case Stage::moving_by_command:
        if (settled) {
            const std::string limit = commanded_limit();
            finish(limit.empty() ? Stage::ready : Stage::stopped, limit);
            rest();
        }
        break;
    case Stage::ready:
    case Stage::stopped:
        if (settled && watchdog_.armed && !watchdog_.stays_armed) {
            rest();
        }
        break;
    default:
        break;
    }
}

/// Of the first motor that stands with power and is not in its place; by the following error that the card
/// last reported.
std::string PmacSession::off_target_sentence() const {
    const auto off_target =
        std::find_if(motors_.begin(), motors_.end(), [](const MotorState& m) { return !m.in_place(); });
    const auto n = static_cast<std::size_t>(off_target - motors_.begin());
    const double at = axes_deg()[n];
    const std::vector<drivers::MotorReading>& readings = readings_.motors();
    return fmt::format("{} is enabled but not at its commanded position: it is at {:.2f} degrees{}; check "
                       "that its amplifier has power, the brake is released and the path is clear",
                       name_of(n),
                       at,
                       readings.size() == motors_.size()
                           ? fmt::format(" instead of {:.2f}", at + to_degrees(readings[n].following_error))
                           : "");
}

bool PmacSession::at_limit(std::size_t n) const {
    constexpr std::uint32_t at_limit = 1U << 11;
    return (motors_[n].word_2 & at_limit) != 0;
}

/// Which motor the card stopped at one of its limits; "" if none.
std::string PmacSession::limit_sentence() const {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (at_limit(n)) {
            return fmt::format("motor {} reached a limit of the card", settings_.axes[n].motor);
        }
    }
    return {};
}

/// The same of a command: of motors that moved, or that it names. Others may stand there since long.
std::string PmacSession::commanded_limit() const {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const int motor = settings_.axes[n].motor;
        const bool moved = n < command_.from.size() && std::abs(motors_[n].counts - command_.from[n]) > 1.0;
        if (!at_limit(n)) {
            continue;
        }
        if (moved) {
            return fmt::format("motor {} reached a limit of the card", motor);
        }
        if (command_.text.find(fmt::format("#{}", motor)) != std::string::npos) {
            return fmt::format("motor {} is at a limit of the card", motor);
        }
    }
    return {};
}

/// Why the card's own watch has stopped the motion; empty: it has not.
std::string PmacSession::unheard() const {
    return mark_ > 0.5 * heard_nothing
               ? ""
               : fmt::format("the card received nothing from this computer for {:.0f} ms: the computer was "
                             "busy, or the connection is slow",
                             1e3 * settings_.abort_after);
}

/// Nothing moves: the card need not watch, and no character that was garbled into ^R finds a program.
void PmacSession::rest() {
    if (!watchdog_.stays_armed) {
        ask(disarm_watchdog, Kind::watch);
        watchdog_.armed = false;
    }
    ask(fmt::format("&{}B0", settings_.system), Kind::watch);
    give_jog_speeds_back();
}

void PmacSession::watch_program(bool settled) {
    constexpr std::uint32_t errors = 3U << 21, held_bit = 1U << 23;
    constexpr int ahead = 4; // a program is calculated before its moves are made
    if (run_.marks_tell) {
        run_.executed = std::clamp(static_cast<int>(std::min(mark_, 1e6)) - ahead, run_.executed, run_.lines);
    }
    const bool all_sent = queue_.empty(); // else the report may be older than our resume
    if ((system_2_ & held_bit) != 0 && !run_.held && all_sent) {
        run_.held = true;
        message_ = "feed hold was triggered outside Millwright";
    }
    if ((system_2_ & errors) != 0) {
        fail("the card ended the program with a run-time error");
    } else if (settled && mark_ > run_.lines + 0.5) {
        run_.executed = run_.lines;
        finish(Stage::ready);
    } else if (settled) {
        const std::string limit = limit_sentence();
        fail(!unheard().empty() ? "the card ended the program: " + unheard()
             : !limit.empty()   ? limit
                                : "the program was ended outside Millwright");
    }
}

void PmacSession::watch_homing() {
    if (homing_.backs_off) {
        homing_.backs_off = false;
        homing_.from = motors_[homing_.axis].counts;
        quiet_polls_ = 0;
        ask(fmt::format("#{}HM", settings_.axes[homing_.axis].motor));
        return;
    }
    const bool found = motors_[homing_.axis].home();
    if (!found && quiet_polls_ <= patient_polls) {
        return; // it stands for a moment where it turns back to its flag
    }
    if (!found) {
        fail(fmt::format("motor {} did not find its home flag", settings_.axes[homing_.axis].motor));
    } else if (homing_.axis + 1 < motors_.size()) {
        home_axis(homing_.axis + 1);
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
    } else if (quiet_polls_ >= 2 && watchdog_.armed && !watchdog_.stays_armed) {
        rest();
    } else if (quiet_polls_ >= 2 &&
               queue_.empty()) { // the link may be dropped then, and the guard is disarmed
        if (watchdog_.armed) {
            rest();
        }
        finish(Stage::stopped, message_);
    }
}

/// Ends whatever is going on: in a state without motion, or on the way there.
void PmacSession::finish(Stage stage, std::string why) {
    const bool given_up = stage_ == Stage::commanding || stage == Stage::alarm;
    stage_ = stage;
    message_ = std::move(why);
    jogging_ = {};
    run_.held = false;
    quiet_polls_ = off_target_polls_ = power_polls_ = 0;
    braking_ = {};
    unexplained_ = false;
    following_.forget();
    for (MotorState& motor : motors_) {
        motor.had_power = motor.enabled();
        motor.was_given_power =
            motor.was_given_power && (stage == Stage::moving_by_command || stage == Stage::commanding);
    }
    if (given_up && stage != Stage::commanding) {
        answer_.break_off(message_);
    }
}

/// The state is not known, or wrong: nothing may have power.
void PmacSession::fail(std::string why) {
    if (stage_ == Stage::alarm) {
        return;
    }
    forget_all();
    kill();
    tell(false, drivers::ConsoleKind::fault, why);
    finish(Stage::alarm, std::move(why));
    ask("CLOSE");
    ask(disable_plcs); // they could give the power back
    give_jog_speeds_back();
}

/// Before a kill: a line on its way must not arrive behind it, since a jog would give power back.
void PmacSession::forget_all() {
    (void)talk_.take_output();
    talk_.forget();
    sent_.reset();
    output_ = "\x18";
    queue_.clear();
    command_.lines.clear();
    exchange_.buffer_open = exchange_.look_first = false;
}

/// The one command that nothing refuses; three times, since a character may be lost.
void PmacSession::kill() {
    output_ += "\x0B\x0B\x0B";
    tell(true, drivers::ConsoleKind::realtime, "^K: all motors disabled");
}

} // namespace millwright::pmac::internal
