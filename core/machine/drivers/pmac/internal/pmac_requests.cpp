// What a person wants of the machine.
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/machine/drivers/pmac/arm_axes.h"
#include "core/machine/drivers/pmac/internal/card_numbers.h"
#include "core/machine/drivers/pmac/internal/command_kind.h"
#include "core/machine/drivers/pmac/internal/pmac_session.h"
#include "core/machine/drivers/pmac/internal/watchdog.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::machine::pmac {

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
        throw Error(fmt::format("the motors are moving, and take no {}", what));
    }
    throw Error(fmt::format("the PMAC is {} and takes no {}", in_words(status().state), what),
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
    } else if (stage_ == Stage::commanding || stage_ == Stage::astir || (rests() && armed_)) {
        command_lines_.clear();
        finish(Stage::stopping);
        unbraked_ = true; // the next report tells what the command set going
    }
}

/// What a command set going: the motors with power alone, since J/ would give it to the others, too.
void PmacSession::brake() {
    unbraked_ = false;
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
    homing_axis_ = n;
    homing_from_ = motors_[n].counts;
    homing_backs_off_ = motors_[n].home() && way * (motors_[n].counts / axis.counts_per_degree - place) > 0.0;
    quiet_polls_ = 0;
    if (homing_backs_off_) {
        set_jog_speed(n, most_jog_speed(n));
        ask(fmt::format("#{}J={:.0f}", axis.motor, place * axis.counts_per_degree));
    } else {
        ask(fmt::format("#{}HM", axis.motor));
    }
}

void PmacSession::enable(double /*now*/) {
    require_rest("power");
    ask(every_motor("J/"));
    power_polls_ = patient_polls;
}

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
            return fmt::format("{} would leave its limits, at {:.2f} degrees", name_of(n), target);
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
    jog_until_ = held ? std::optional(now + jog.dead_man) : std::nullopt;
    quiet_polls_ = 0;
}

void PmacSession::stop_jog(double /*now*/) {
    halt_jog();
}

void PmacSession::halt_jog() {
    if (stage_ != Stage::jogging || jog_stopping_) {
        return;
    }
    forget_queue();
    if (enabled()) {
        ask(every_motor("J/"));
    } else {
        kill();
    }
    jog_stopping_ = true;
    jog_until_.reset();
    quiet_polls_ = 0;
}

void PmacSession::check_command(const std::vector<std::string>& lines) const {
    if (lines.empty()) {
        throw Error("there is nothing in the command");
    }
    for (const std::string& line : lines) {
        constexpr std::size_t longest = 240;
        const bool plain = std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; });
        if (!plain || line.empty() || line.size() > longest) {
            throw Error(fmt::format("a command is plain text of 1 to {} characters", longest));
        }
        if (line.front() == '^') {
            throw Error(fmt::format("'{}' means a control character, which has no place in a line", line),
                        {},
                        "Stop, emergency stop and unlock do what ^A, ^K and others would");
        }
        if (jogs_without_end(line)) {
            throw Error(fmt::format("'{}' would jog until somebody thinks of stopping it", line),
                        {},
                        "the jog buttons stop when they are let go of; J:500 goes 500 counts");
        }
        if (opens_loop(line)) {
            throw Error(fmt::format("'{}' would drive a motor without its loop: no speed, no limit and no "
                                    "watchdog holds it",
                                    line),
                        {},
                        "J:500 goes 500 counts");
        }
    }
}

/// Goals are known before anything moves; what a program does is watched.
void PmacSession::check_goals(const std::vector<std::string>& lines) const {
    int motor = addresses_.size() > 1 ? addresses_[1] - '0' : 0;
    std::vector<double> from;
    for (const MotorState& state : motors_) {
        from.push_back(state.counts);
    }
    std::vector<double> targets = from;
    for (const std::string& line : lines) {
        for (const MotorGoal& goal : goals_of(line, motor)) {
            const auto axis = std::ranges::find(settings_.axes, goal.motor, &PmacAxis::motor);
            const auto n = static_cast<std::size_t>(axis - settings_.axes.begin());
            if (n < targets.size()) {
                targets[n] = goal.counts + (goal.from_here ? targets[n] : 0.0);
            }
        }
        if (const std::string why = leaves_limits(from, targets); !why.empty()) {
            throw Error(fmt::format("'{}' is not sent: {}", line, why));
        }
    }
}

/// Whether that is all there is to do about `lines`.
bool PmacSession::stopped_by_command(const std::vector<std::string>& lines) {
    if (!active() || stage_ == Stage::loading) {
        return false;
    }
    if (std::all_of(lines.begin(), lines.end(), only_kills)) {
        fail("a command took the power away");
    } else if (std::all_of(lines.begin(), lines.end(), only_stops)) {
        halt();
    } else {
        return false;
    }
    answer_ = {answer_.number + 1, CommandAnswer::State::done, {}};
    return true;
}

/// The first motor without power that `lines` would give it to.
std::optional<std::size_t> PmacSession::given_power(const std::vector<std::string>& lines) const {
    int addressed = addresses_.size() > 1 ? addresses_[1] - '0' : 0;
    std::vector<char> powered;
    for (const MotorState& motor : motors_) {
        powered.push_back(motor.enabled() ? 1 : 0);
    }
    bool stored = false;
    for (const std::string& line : lines) {
        stored = opens_buffer(line) || (stored && !closes_buffer(line));
        if (stored) {
            continue;
        }
        for (const PowerChange& change : power_changes_of(line, addressed)) {
            for (std::size_t n = 0; n < powered.size(); ++n) {
                if (change.motor && *change.motor != settings_.axes[n].motor) {
                    continue;
                }
                if (change.given && powered[n] == 0) {
                    return n;
                }
                powered[n] = change.given ? 1 : 0;
            }
        }
    }
    return std::nullopt;
}

/// Stops that were typed would give power to motors without: those that have it brake, and that is all.
/// Throws Error where nothing is to be stopped, and for lines that do more.
bool PmacSession::brakes_instead(const std::vector<std::string>& lines) {
    const auto to = given_power(lines);
    if (!to || lines_may_power_ || stage_ == Stage::alarm) { // which takes none of them anyway
        return false;
    }
    const bool moves = stage_ == Stage::astir || stage_ == Stage::commanding || (rests() && !standing());
    if (!moves || !std::all_of(lines.begin(), lines.end(), only_stops)) {
        throw Error(
            fmt::format("'{}' would give power to {}, which has none", fmt::join(lines, " "), name_of(*to)),
            {},
            "look at the machine, then give its motors power: --power on the command line");
    }
    command_lines_.clear();
    finish(Stage::stopping);
    unbraked_ = true; // the next report tells which move
    answer_ = {answer_.number + 1, CommandAnswer::State::done, {}};
    return true;
}

int PmacSession::load(const std::vector<std::string>& lines) {
    if (std::any_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.enabled(); })) {
        throw Error("the motors have power, and a wrong gain or limit would move them at once",
                    {},
                    "take it away first, and give it again when the settings were looked at");
    }
    return command(lines, true);
}

int PmacSession::command(const std::vector<std::string>& lines, bool all) {
    check_command(lines);
    check_goals(lines);
    if (stopped_by_command(lines) || brakes_instead(lines)) {
        return answer_.number;
    }
    const bool waits = answer_.state == CommandAnswer::State::pending;
    const bool asks = std::all_of(lines.begin(), lines.end(), only_asks);
    if (!asks && rests()) {
        give_jog_speeds_back();
    }
    const bool stops = std::all_of(
        lines.begin(), lines.end(), [](const auto& line) { return only_stops(line) || only_kills(line); });
    if (stage_ == Stage::astir && stops) {
        finish(Stage::commanding);
    } else if (stage_ == Stage::alarm && !waits && !link_lost_ &&
               std::all_of(lines.begin(), lines.end(), only_sets)) {
        // nothing has power: what a test of a motor had borrowed is given back
    } else if (waits || !asks || !(active() || stage_ == Stage::astir) || stage_ == Stage::loading) {
        require_rest("command");
        finish(Stage::commanding);
    }
    begin_command(lines, all);
    return answer_.number;
}

void PmacSession::begin_command(const std::vector<std::string>& lines, bool all) {
    answer_ = {answer_.number + 1, CommandAnswer::State::pending, {}};
    command_goes_on_ = all;
    command_refused_ = false;
    command_lines_.assign(lines.begin(), lines.end());
    only_set_ = std::all_of(lines.begin(), lines.end(), only_sets);
    int addressed = 0;
    closes_loops_ = std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        const auto changes = power_changes_of(line, addressed);
        return std::any_of(changes.begin(), changes.end(), [](const PowerChange& c) { return c.given; });
    });
    commanded_.clear();
    for (const std::string& line : lines) {
        commanded_ += line + "\n";
    }
    commanded_from_.clear();
    for (const MotorState& motor : motors_) {
        commanded_from_.push_back(motor.counts);
    }
    next_command();
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
