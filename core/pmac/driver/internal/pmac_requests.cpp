// What a person wants of the machine as a whole.
#include "core/base/error.h"
#include "core/pmac/driver/internal/buffer_words.h"
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/driver/internal/watchdog.h"
#include "core/pmac/driver/pmac_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace millwright::pmac::internal {

namespace {

/// Loops, conditions, jumps, and what is sent as a command: as far as one can see.
bool may_leave_order(const std::string& line) {
    constexpr std::array<std::string_view, 6> words{"WHILE", "IF", "GOTO", "GOSUB", "CALL", "\""};
    std::string upper(line);
    std::ranges::transform(
        upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return std::ranges::any_of(words,
                               [&](std::string_view word) { return upper.find(word) != std::string::npos; });
}

} // namespace

bool PmacSession::active() const {
    return stage_ == Stage::running || stage_ == Stage::loading || stage_ == Stage::jogging ||
           stage_ == Stage::homing || stage_ == Stage::stopping;
}

bool PmacSession::rests() const {
    return stage_ == Stage::ready || stage_ == Stage::stopped;
}

void PmacSession::require_rest(std::string_view what) const {
    if (rests() && standing()) {
        return;
    }
    if (rests()) {
        throw Error(fmt::format("the motors are moving: {} is not possible now", what));
    }
    throw Error(fmt::format("the PMAC is {}: {} is not possible", drivers::in_words(status().state), what),
                {},
                stage_ == Stage::alarm ? message_ + "; inspect the machine, then reset the alarm" : "");
}

void PmacSession::require_enabled(std::string_view what) const {
    if (!enabled()) {
        throw Error(fmt::format("the motors are not enabled: {} is not possible", what),
                    {},
                    "inspect the machine, then enable the motors");
    }
}

std::string PmacSession::every_motor(std::string_view command) const {
    std::string line;
    for (const PmacAxis& axis : settings_.axes) {
        line += fmt::format("#{}{}", axis.motor, command);
    }
    return line;
}

void PmacSession::check_stays_in_buffer(const std::string& line) {
    if (has_buffer_word(line)) {
        throw Error(fmt::format("'{}' is not a line of a motion program", line), {}, buffer_word_hint);
    }
}

void PmacSession::start(const std::vector<std::string>& lines, double /*now*/) {
    require_rest("a program");
    require_enabled("a program");
    if (!position_known()) {
        throw Error("the position is unknown, so a program cannot run", {}, "home the machine first");
    }
    for (const std::string& line : lines) {
        check_guard(line);
        check_stays_in_buffer(line);
    }
    answer_.forget();
    finish(Stage::loading);
    run_.lines = static_cast<int>(lines.size());
    run_.executed = 0;
    mark_ = 0.0;
    run_.marks_tell = std::none_of(lines.begin(), lines.end(), may_leave_order);
    watchdog_.armed = false; // no sign of life is heard while a buffer is open
    for (const std::string& line : {std::string(disarm_watchdog),
                                    std::string("CLOSE"),
                                    fmt::format("OPEN PROG {}", settings_.program),
                                    std::string("CLEAR"),
                                    std::string("P1000=0")}) {
        ask(line, Kind::program);
    }
    for (int n = 0; n < run_.lines; ++n) {
        if (run_.marks_tell) {
            ask(fmt::format("P1000={}", n + 1), Kind::program);
        }
        ask(lines[static_cast<std::size_t>(n)], Kind::program);
    }
    ask("DWELL0", Kind::program); // waits for all motion
    ask(fmt::format("P1000={}", run_.lines + 1), Kind::program);
    ask("CLOSE", Kind::program);
    ask("P1000=0");
    arm();
    ask(fmt::format("&{}B{}R", settings_.system, settings_.program), Kind::run);
}

void PmacSession::hold(double now) {
    if (stage_ == Stage::running && !run_.held) {
        ask(fmt::format("&{}H", settings_.system));
        run_.held = true;
    } else if (stage_ == Stage::jogging) {
        stop_jog(now);
    }
}

void PmacSession::resume(double /*now*/) {
    if (stage_ == Stage::running && run_.held) {
        ask(fmt::format("&{}R", settings_.system));
        run_.held = false;
        message_.clear();
    }
}

void PmacSession::stop(double /*now*/) {
    halt();
}

void PmacSession::halt() {
    if (stage_ == Stage::loading) {
        queue_.clear();
        ask("CLOSE");
        finish(Stage::stopped);
    } else if (stage_ == Stage::running) {
        ask(fmt::format("&{}H", settings_.system));
        finish(Stage::stopping);
    } else if (stage_ == Stage::jogging) {
        halt_jog();
        stage_ = Stage::stopping;
    } else if (stage_ == Stage::homing) {
        forget_queue();
        ask(every_motor("J/"));
        finish(Stage::stopping);
    } else if (stage_ == Stage::commanding || stage_ == Stage::moving_by_command ||
               (rests() && (watchdog_.armed || !queue_.empty()))) {
        command_.lines.clear();
        finish(Stage::stopping);
        braking_.due = true; // the next report tells what the command set going
    }
    if (power_.plcs_run) {
        switch_plcs_off();
    }
}

/// What a command set going: the motors with power alone, since J/ would give it to the others, too.
void PmacSession::brake() {
    braking_.due = false;
    if ((system_1_ & 1U) != 0) { // a program runs
        ask(fmt::format("&{}{}", settings_.system, enabled() ? "A" : "H"));
    }
    std::string line;
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (motors_[n].enabled()) {
            line += fmt::format("#{}J/", settings_.axes[n].motor);
        }
    }
    if (!line.empty()) {
        ask(std::move(line));
    }
}

/// All that was to be asked, but for what a person wants to know.
void PmacSession::forget_queue() {
    std::erase_if(queue_, [](const Request& request) {
        return request.kind != Kind::command && request.kind != Kind::address;
    });
}

void PmacSession::emergency_stop(double /*now*/) {
    if (stage_ != Stage::closed && !link_lost()) {
        fail("emergency stop");
    }
}

void PmacSession::reset(double /*now*/) {
    if (stage_ == Stage::alarm && !link_lost()) {
        finish(Stage::ready);
        was_home_ = position_known();
    }
}

void PmacSession::home(double now) {
    require_rest("homing");
    require_enabled("homing");
    if (motors_.empty()) {
        throw Error("there is no axis to home");
    }
    finish(Stage::homing);
    was_home_ = false;
    arm();
    home_axis(0);
    next_poll_ = now;
}

/// A motor looks for its flag in one direction only: where it is known to stand behind it, it goes back
/// first.
void PmacSession::home_axis(std::size_t n) {
    constexpr double before_flag_deg = 5.0;
    const PmacAxis& axis = settings_.axes[n];
    const double way = readings_.way_home(n);
    double place = -way * before_flag_deg;
    place = std::clamp(
        place, std::min(0.0, axis.min_deg.value_or(place)), std::max(0.0, axis.max_deg.value_or(place)));
    homing_.axis = n;
    homing_.from = motors_[n].counts;
    homing_.backs_off = motors_[n].home() && way * (motors_[n].counts / axis.counts_per_degree - place) > 0.0;
    quiet_polls_ = 0;
    if (homing_.backs_off) {
        set_jog_speed(n, most_jog_speed(n));
        ask(fmt::format("#{}J={:.0f}", axis.motor, place * axis.counts_per_degree));
    } else {
        ask(fmt::format("#{}HM", axis.motor));
    }
}

void PmacSession::enable(double /*now*/) {
    require_rest("enabling the motors");
    if (!guard_.runs()) {
        throw Error(guard_is_off, {}, "connect again, which rewrites the guard");
    }
    power_.given = true;
    ask(every_motor("J/"));
    power_polls_ = patient_polls;
}

void PmacSession::set_overrides(const drivers::Overrides& wanted) {
    if (stage_ == Stage::closed || link_lost() || !greeted()) {
        throw Error("the PMAC is not connected, so overrides are not possible");
    }
    constexpr int most = 100; // faster than programmed is no business of a hand
    overrides_.feed = std::clamp(wanted.feed, 0, most);
    ask(fmt::format("&{}%{}", settings_.system, overrides_.feed));
}

} // namespace millwright::pmac::internal
