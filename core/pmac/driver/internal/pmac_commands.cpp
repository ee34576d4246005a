// Lines that a person types, or has in a file: what may be sent of them, and when.
#include "core/base/error.h"
#include "core/pmac/driver/guard_rules.h"
#include "core/pmac/driver/internal/buffer_words.h"
#include "core/pmac/driver/internal/command_kind.h"
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/driver/pmac_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace millwright::pmac::internal {

void PmacSession::check_command(const std::vector<std::string>& lines) const {
    if (lines.empty()) {
        throw Error("the command is empty");
    }
    for (const std::string& line : lines) {
        constexpr std::size_t longest = 240;
        const bool plain = std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; });
        if (!plain || line.empty() || line.size() > longest) {
            throw Error(fmt::format("a command must be plain text of 1 to {} characters", longest));
        }
        if (!sets_p0(line) && (line.front() == '.' || (line.front() >= '0' && line.front() <= '9'))) {
            throw Error(fmt::format("'{}' starts with a number but contains more", line),
                        {},
                        "use a number alone to set P0, or a command that starts with a letter, # or &");
        }
        if (line.front() == '^') {
            throw Error(fmt::format("'{}' is a control character, which is not allowed in a line", line),
                        {},
                        "use stop, emergency stop and unlock instead of ^A, ^K and others; the driver "
                        "requests the reports (^B, ^C, ^F, ^G, ^P, ^V) itself and shows them all the time");
        }
        if (jogs_without_end(line)) {
            throw Error(fmt::format("'{}' would jog without an end", line),
                        {},
                        "use the jog buttons, which stop when released, or a jog with an end: J:500 moves "
                        "500 counts");
        }
        if (opens_loop(line)) {
            throw Error(
                fmt::format(
                    "'{}' would drive a motor in open loop, without control of speed, limits or watchdog",
                    line),
                {},
                "J:500 goes 500 counts");
        }
        check_guard(line);
    }
}

/// A line of a person, or of a program.
void PmacSession::check_guard(const std::string& line) {
    if (const std::string why = guard_refusal(line); !why.empty()) {
        throw Error(
            fmt::format("'{}' would weaken the guard that stops the motors when the connection is lost",
                        line),
            {},
            why);
    }
    if (sets_handshake(line)) {
        throw Error(fmt::format("'{}' would change the handshake, which is controlled by the driver", line));
    }
}

/// While a buffer is open nobody is heard, and the guard is disarmed: nothing may move then.
void PmacSession::check_buffers(const std::vector<std::string>& lines) const {
    bool stored = false, may_move = false;
    for (const std::string& line : lines) {
        if (opens_buffer(line) && may_move && any_power()) {
            throw Error(fmt::format("'{}' would disarm the guard while motors may move", line),
                        {},
                        "send it after the lines before it have finished");
        }
        may_move = may_move || (!stored && !opens_buffer(line) && !begins_nothing(line));
        stored = opens_buffer(line) || (stored && !closes_buffer(line));
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
        fail("a command disabled the motors");
    } else if (std::all_of(lines.begin(), lines.end(), only_stops)) {
        halt();
    } else {
        return false;
    }
    answer_ = {answer_.number + 1, drivers::CommandAnswer::State::done, {}};
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

/// Stops that were typed would give power to motors without: those that have it brake, and that is all. Where
/// nothing moves nothing is sent. Throws Error for lines that do more, and for a J/ where nothing moves,
/// which is meant to give power.
bool PmacSession::brakes_instead(const std::vector<std::string>& lines) {
    const auto to = given_power(lines);
    if (!to || lines_may_power_ || stage_ == Stage::alarm) { // which takes none of them anyway
        return false;
    }
    const bool moves =
        stage_ == Stage::moving_by_command || stage_ == Stage::commanding || (rests() && !standing());
    if (!moves && std::all_of(lines.begin(), lines.end(), only_aborts)) {
        answer_ = {
            answer_.number + 1,
            drivers::CommandAnswer::State::done,
            fmt::format("nothing moves; {} is disabled, and the command did not enable it", name_of(*to))};
        return true;
    }
    if (!moves || !std::all_of(lines.begin(), lines.end(), only_stops)) {
        throw PowerRefused(
            fmt::format("'{}' would enable {}, which is disabled", fmt::join(lines, " "), name_of(*to)),
            {},
            "inspect the machine, then enable its motors");
    }
    command_lines_.clear();
    finish(Stage::stopping);
    unbraked_ = true; // the next report tells which move
    answer_ = {answer_.number + 1, drivers::CommandAnswer::State::done, {}};
    return true;
}

int PmacSession::load(const std::vector<std::string>& lines) {
    if (any_power()) {
        throw Error("the motors are enabled, and a wrong gain or limit would move them immediately",
                    {},
                    "disable the motors first; enable them again after checking the settings");
    }
    return command(lines, true);
}

/// A buffer is closed before the next one is opened, as the card has it.
void PmacSession::check_open(const std::vector<std::string>& lines) const {
    std::string open = typed_.kept().empty() ? "" : typed_.kept().front();
    for (const std::string& line : lines) {
        if (opens_buffer(line) && !open.empty()) {
            throw Error(second_open_message(line), {}, second_open_hint(open));
        }
        open = opens_buffer(line) ? line : closes_buffer(line) ? "" : open;
    }
}

void PmacSession::keep_until_close(const std::vector<std::string>& lines) {
    typed_.keep(lines);
    const std::size_t count = typed_.kept().size() - 1;
    answer_ = {answer_.number + 1,
               drivers::CommandAnswer::State::done,
               fmt::format("{}: {} {} kept until CLOSE",
                           typed_.kept().front(),
                           count,
                           count == 1 ? "line is" : "lines are")};
    tell(false, drivers::ConsoleKind::message, lines.back() + ": not yet sent; " + answer_.text);
}

int PmacSession::command(const std::vector<std::string>& given, bool all) {
    const std::vector<std::string> parts = split_at_buffer_words(given);
    check_command(parts);
    check_open(parts);
    if (all && !typed_.kept().empty()) {
        throw Error(
            "a file cannot be loaded while a buffer is open", {}, second_open_hint(typed_.kept().front()));
    }
    const bool may_wait = !all && answer_.state != drivers::CommandAnswer::State::pending;
    const std::size_t now = may_wait ? typed_.count_to_send(parts) : parts.size();
    if (now == 0) {
        keep_until_close(parts);
        return answer_.number;
    }
    const auto rest = parts.begin() + static_cast<std::ptrdiff_t>(now);
    const std::vector<std::string> typed(parts.begin(), rest);
    const std::vector<std::string> lines = all ? typed : typed_.completed(typed);
    check_goals(lines);
    check_buffers(all ? parts : typed_.completed(parts));
    if (stopped_by_command(lines) || brakes_instead(lines)) {
        return answer_.number;
    }
    const bool waits = answer_.state == drivers::CommandAnswer::State::pending;
    const bool asks = std::all_of(lines.begin(), lines.end(), only_asks);
    if (!asks && rests()) {
        give_jog_speeds_back();
    }
    const bool stops = std::all_of(
        lines.begin(), lines.end(), [](const auto& line) { return only_stops(line) || only_kills(line); });
    if (stage_ == Stage::moving_by_command && stops) {
        finish(Stage::commanding);
    } else if (stage_ == Stage::alarm && !waits && !link_lost_ &&
               std::all_of(lines.begin(), lines.end(), only_sets)) {
        // nothing has power: what a test of a motor had borrowed is given back
    } else if (waits || !asks || !(active() || stage_ == Stage::moving_by_command) ||
               stage_ == Stage::loading) {
        require_rest("a command");
        finish(Stage::commanding);
    }
    begin_command(lines, all);
    typed_.sent(typed);
    typed_.keep({rest, parts.end()});
    return answer_.number;
}

/// The lines of a buffer that the card did not open would act at once.
void PmacSession::skip_buffer() {
    buffer_open_ = false;
    const auto close = std::ranges::find_if(command_lines_, closes_buffer);
    command_lines_.erase(command_lines_.begin(), close == command_lines_.end() ? close : std::next(close));
}

void PmacSession::begin_command(const std::vector<std::string>& lines, bool all) {
    answer_ = {answer_.number + 1, drivers::CommandAnswer::State::pending, {}};
    command_goes_on_ = all;
    command_refused_ = false;
    command_lines_.assign(lines.begin(), lines.end());
    only_set_ = std::all_of(lines.begin(), lines.end(), only_sets);
    stays_armed_ = stays_armed_ || std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
                       return may_move_later(line, settings_.system);
                   });
    int addressed = 0;
    closes_loops_ = false;
    for (const std::string& line : lines) {
        for (const PowerChange& change : power_changes_of(line, addressed)) {
            closes_loops_ = closes_loops_ || change.given;
            for (std::size_t n = 0; n < motors_.size() && change.given; ++n) {
                const bool other = change.motor && *change.motor != settings_.axes[n].motor;
                motors_[n].gets_power = motors_[n].gets_power || !other;
                motors_[n].was_given_power = motors_[n].was_given_power || !other;
            }
        }
    }
    gave_power_ = gave_power_ || closes_loops_;
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

} // namespace millwright::pmac::internal
