// What a person wants of the machine.
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/machine/drivers/pmac/internal/pmac_session.h"
#include "core/machine/drivers/pmac/internal/watchdog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::machine::pmac {

bool PmacSession::active() const {
    return stage_ == Stage::running || stage_ == Stage::loading || stage_ == Stage::jogging ||
           stage_ == Stage::homing || stage_ == Stage::stopping;
}

void PmacSession::require_rest(std::string_view what) const {
    const bool rests = stage_ == Stage::ready || stage_ == Stage::stopped;
    if (rests && standing()) {
        return;
    }
    if (rests) {
        throw Error(fmt::format("the motors are moving, and take no {}", what));
    }
    throw Error(fmt::format("the PMAC is {} and takes no {}", to_text(status().state), what),
                {},
                stage_ == Stage::alarm ? message_ + "; look at the machine, then reset it" : "");
}

void PmacSession::require_enabled(std::string_view what) const {
    if (!enabled()) {
        throw Error(fmt::format("the motors have no power, so there is no {}", what),
                    {},
                    "look at the machine, then enable them");
    }
}

std::string PmacSession::every_motor(std::string_view command) const {
    std::string line;
    for (const PmacAxis& axis : settings_.axes) {
        line += fmt::format("#{}{}", axis.motor, command);
    }
    return line;
}

void PmacSession::start(const std::vector<std::string>& lines, double /*now*/) {
    require_rest("program");
    require_enabled("program");
    if (!position_known()) {
        throw Error("the position is not known, so there is no program", {}, "home first");
    }
    finish(Stage::loading);
    program_lines_ = static_cast<int>(lines.size());
    executed_ = 0;
    mark_ = 0.0;
    marks_tell_ = std::none_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.find_first_of("(\"") != std::string::npos; // loops and conditions, as far as one can see
    });
    armed_ = false; // nobody is heard while a buffer is open
    for (const std::string& line : {std::string(disarm_watchdog),
                                    std::string("CLOSE"),
                                    fmt::format("OPEN PROG {}", settings_.program),
                                    std::string("CLEAR"),
                                    std::string("P1000=0")}) {
        ask(line, Kind::program);
    }
    for (int n = 0; n < program_lines_; ++n) {
        if (marks_tell_) {
            ask(fmt::format("P1000={}", n + 1), Kind::program);
        }
        ask(lines[static_cast<std::size_t>(n)], Kind::program);
    }
    ask("DWELL0", Kind::program); // waits for all motion
    ask(fmt::format("P1000={}", program_lines_ + 1), Kind::program);
    ask("CLOSE", Kind::program);
    ask("P1000=0");
    arm();
    ask(fmt::format("&{}B{}R", settings_.system, settings_.program), Kind::run);
}

void PmacSession::hold(double now) {
    if (stage_ == Stage::running && !held_) {
        ask(fmt::format("&{}H", settings_.system));
        held_ = true;
    } else if (stage_ == Stage::jogging) {
        stop_jog(now);
    }
}

void PmacSession::resume(double /*now*/) {
    if (stage_ == Stage::running && held_) {
        ask(fmt::format("&{}R", settings_.system));
        held_ = false;
        message_.clear();
    }
}

void PmacSession::stop(double now) {
    if (stage_ == Stage::loading) {
        queue_.clear();
        ask("CLOSE");
        finish(Stage::stopped);
    } else if (stage_ == Stage::running) {
        ask(fmt::format("&{}H", settings_.system));
        finish(Stage::stopping);
    } else if (stage_ == Stage::jogging) {
        stop_jog(now);
        stage_ = Stage::stopping;
    } else if (stage_ == Stage::homing) {
        queue_.clear();
        ask(every_motor("J/"));
        finish(Stage::stopping);
    } else if (stage_ == Stage::commanding) {
        command_lines_.clear();
    } else if ((stage_ == Stage::ready || stage_ == Stage::stopped) && armed_) {
        if (!standing()) { // what a command began
            enabled() ? ask(every_motor("J/")) : kill();
        }
        finish(Stage::stopping);
    }
}

void PmacSession::emergency_stop(double /*now*/) {
    if (stage_ != Stage::closed && !link_lost_) {
        fail("emergency stop");
    }
}

void PmacSession::reset(double /*now*/) {
    if (stage_ == Stage::alarm && !link_lost_) {
        finish(Stage::ready);
        was_home_ = position_known();
    }
}

void PmacSession::home(double now) {
    require_rest("homing");
    require_enabled("homing");
    if (motors_.empty()) {
        throw Error("there is no axis that could be homed");
    }
    finish(Stage::homing);
    homing_axis_ = 0;
    was_home_ = false;
    arm();
    ask(fmt::format("#{}HM", settings_.axes.front().motor));
    next_poll_ = now;
}

void PmacSession::enable(double /*now*/) {
    require_rest("power");
    ask(every_motor("J/"));
}

/// While others are jogged on, an axis whose key is up brakes.
void PmacSession::let_go_of(std::size_t n) {
    MotorState& motor = motors_[n];
    if (std::abs(motor.target - motor.counts) > 1.0) {
        ask(fmt::format("#{}J/", settings_.axes[n].motor));
        motor.target = motor.counts;
    }
}

void PmacSession::jog_axis(std::size_t n, double way_deg, double speed_deg_per_s, bool held) {
    const PmacAxis& axis = settings_.axes[n];
    MotorState& motor = motors_[n];
    const double from = stage_ == Stage::jogging && !held ? motor.target : motor.counts;
    double target = from + way_deg * axis.counts_per_degree;
    if (position_known()) {
        const double most = axis.max_deg ? *axis.max_deg * axis.counts_per_degree : target;
        const double least = axis.min_deg ? *axis.min_deg * axis.counts_per_degree : target;
        const bool out = target > std::max(most, from) || target < std::min(least, from);
        if (out) {
            throw Error(fmt::format("{} would leave its limits, at {:.2f} degrees",
                                    axis.letter,
                                    target / axis.counts_per_degree));
        }
    }
    motor.target = std::round(target);
    constexpr double per_ms = 1000.0;
    const double speed = std::min(speed_deg_per_s, axis.jog_deg_per_s) * axis.counts_per_degree / per_ms;
    ask(fmt::format("I{}22={:.6f}", axis.motor, speed));
    readings_.set_jog_speed(n, speed);
    ask(fmt::format("#{}J={:.0f}", axis.motor, motor.target));
}

void PmacSession::jog(const Jog& jog, double now) {
    if (stage_ != Stage::jogging || jog_stopping_) {
        require_rest("jog");
    }
    require_enabled("jog");
    double longest = 0.0;
    for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
        if (!std::isfinite(jog.way[n]) || (n >= std::ssize(motors_) && std::abs(jog.way[n]) > 0.0)) {
            throw Error("this PMAC has no such axis to jog");
        }
        longest = std::max(longest, std::abs(jog.way[n]));
    }
    if (!(longest > 0.0) || !(jog.speed > 0.0)) {
        throw Error("a jog has a way and a speed");
    }
    std::deque<Request> before = queue_;
    const std::vector<MotorState> motors = motors_;
    try {
        if (stage_ != Stage::jogging) {
            arm();
        }
        for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
            if (std::abs(jog.way[n]) > 0.0) {
                jog_axis(static_cast<std::size_t>(n),
                         to_degrees(jog.way[n]),
                         to_degrees(jog.speed) * std::abs(jog.way[n]) / longest,
                         jog.dead_man > 0.0);
            } else if (stage_ == Stage::jogging && jog.dead_man > 0.0) {
                let_go_of(static_cast<std::size_t>(n));
            } else if (stage_ != Stage::jogging) {
                motors_[static_cast<std::size_t>(n)].target = motors_[static_cast<std::size_t>(n)].counts;
            }
        }
    } catch (const Error&) { // nothing of it
        queue_ = std::move(before);
        motors_ = motors;
        throw;
    }
    if (stage_ != Stage::jogging) {
        finish(Stage::jogging);
    }
    jog_until_ = jog.dead_man > 0.0 ? std::optional(now + jog.dead_man) : std::nullopt;
    quiet_polls_ = 0;
}

void PmacSession::stop_jog(double /*now*/) {
    if (stage_ != Stage::jogging || jog_stopping_) {
        return;
    }
    queue_.clear();
    if (enabled()) {
        ask(every_motor("J/"));
    } else {
        kill();
    }
    jog_stopping_ = true;
    jog_until_.reset();
    quiet_polls_ = 0;
}

int PmacSession::command(const std::vector<std::string>& lines, bool all) {
    require_rest("command");
    if (lines.empty()) {
        throw Error("there is nothing in the command");
    }
    for (const std::string& line : lines) {
        constexpr std::size_t longest = 240;
        const bool plain = std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; });
        if (!plain || line.empty() || line.size() > longest) {
            throw Error(fmt::format("a command is plain text of 1 to {} characters", longest));
        }
    }
    finish(Stage::commanding);
    answer_ = {answer_.number + 1, CommandAnswer::State::pending, {}};
    command_goes_on_ = all;
    command_lines_.assign(lines.begin(), lines.end());
    next_command();
    return answer_.number;
}

void PmacSession::set_overrides(const Overrides& wanted) {
    if (stage_ == Stage::closed || link_lost_ || !greeted()) {
        throw Error("the PMAC is not connected and takes no overrides");
    }
    constexpr int most = 100; // faster than programmed is no business of a hand
    overrides_.feed = std::clamp(wanted.feed, 0, most);
    ask(fmt::format("&{}%{}", settings_.system, overrides_.feed));
}

} // namespace millwright::machine::pmac
