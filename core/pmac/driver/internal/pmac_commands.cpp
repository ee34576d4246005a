// Lines that a person types, or has in a file: what may be sent of them, and when.
#include "core/base/error.h"
#include "core/pmac/driver/guard_rules.h"
#include "core/pmac/driver/internal/buffer_words.h"
#include "core/pmac/driver/internal/command_kind.h"
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/driver/internal/watchdog.h"
#include "core/pmac/driver/pmac_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace millwright::pmac::internal {

namespace {

template <class Rule> bool are_all(const std::vector<std::string>& lines, const Rule& rule) {
    return std::all_of(lines.begin(), lines.end(), [&](const std::string& line) { return rule(line); });
}

bool asks_or_disables_plcs(const std::string& line) {
    return only_asks(line) || only_disables_plcs(line);
}

bool only_ends_motion(const std::string& line) {
    return only_stops(line) || only_kills(line) || only_disables_plcs(line);
}

bool is_taken_in_alarm(const std::string& line) {
    return only_sets(line) || only_kills(line) || asks_or_disables_plcs(line);
}

} // namespace

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
            throw Error(
                fmt::format("'{}' is a control character, which is not allowed in a line", line),
                {},
                "^A, ^D and ^K are allowed alone; the driver requests the reports (^B, ^C, ^F, ^G, ^P, "
                "^V) itself and shows them all the time");
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

/// While a buffer is open no sign of life is heard, and the guard is disarmed: nothing may move then.
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

/// Whether that is all there is to do about `lines`: stops of what is under way, and of what PLC programs
/// move.
bool PmacSession::stopped_by_command(const std::vector<std::string>& lines) {
    constexpr std::uint32_t program_runs = 1; // the card refuses a K then
    const bool busy = active() || stage_ == Stage::commanding;
    const bool moves = stage_ == Stage::moving_by_command || (rests() && !standing());
    if ((busy || (moves && (system_1_ & program_runs) != 0)) && are_all(lines, only_kills)) {
        fail("a command disabled the motors");
    } else if ((busy || (moves && power_.plcs_run)) && are_all(lines, only_stops)) {
        halt();
    } else if (stage_ == Stage::commanding && are_all(lines, only_disables_plcs)) {
        switch_plcs_off();
        return true;
    } else {
        return false;
    }
    answer_.begin(drivers::CommandAnswer::State::done);
    return true;
}

/// Whether `given` is a control character that stops, by its name, and has been acted on. A character itself
/// would act on more: ^A gives power to killed motors, ^D stops the guard.
bool PmacSession::acted_on_key(const std::vector<std::string>& given) {
    std::string key = given.size() == 1 ? given.front() : "";
    std::erase(key, ' ');
    const bool heard = stage_ != Stage::closed && stage_ != Stage::greeting && !link_lost();
    if (!heard || key.size() != 2 || key.front() != '^') {
        return false;
    }
    switch (key.back()) {
    case 'A':
    case 'a':
        if (rests() && !standing()) {
            finish(Stage::stopping);
            braking_.due = true;
        }
        halt();
        break;
    case 'K':
    case 'k':
        if (active() || stage_ == Stage::commanding || stage_ == Stage::moving_by_command) {
            fail("a command disabled the motors");
        } else {
            kill();
            switch_plcs_off();
        }
        break;
    case 'D':
    case 'd':
        if (exchange_.buffer_open || stage_ == Stage::loading) {
            halt();
        }
        switch_plcs_off();
        break;
    default:
        return false;
    }
    if (!answer_.pending()) {
        answer_.begin(drivers::CommandAnswer::State::done);
    }
    return true;
}

/// The content of a program of the card is unknown here: it may enable motors.
void PmacSession::check_programs(const std::vector<std::string>& lines, bool file) const {
    if (lines_may_power_ || enabled()) {
        return;
    }
    bool stored = false;
    for (const std::string& line : lines) {
        stored = opens_buffer(line) || (stored && !closes_buffer(line));
        if (!stored && (enables_plc(line) || runs_program(line)) && !only_stops(line)) {
            throw PowerRefused(
                fmt::format("'{}' runs a program of the card, which could enable motors", line),
                {},
                file ? "leave the line out of the file, inspect the machine, enable its motors, "
                       "then send the line"
                     : "inspect the machine, then enable its motors");
        }
    }
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
        answer_.begin(
            drivers::CommandAnswer::State::done,
            fmt::format("nothing moves; {} is disabled, and the command did not enable it", name_of(*to)));
        return true;
    }
    if (!moves || !std::all_of(lines.begin(), lines.end(), only_stops)) {
        throw PowerRefused(
            fmt::format("'{}' would enable {}, which is disabled", fmt::join(lines, " "), name_of(*to)),
            {},
            "inspect the machine, then enable its motors");
    }
    command_.lines.clear();
    finish(Stage::stopping);
    braking_.due = true; // the next report tells which move
    answer_.begin(drivers::CommandAnswer::State::done);
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

/// A buffer is closed before the next one is opened, as the card has it, and holds lines of a program: others
/// would act at once, with the guard disarmed.
void PmacSession::check_open(const std::vector<std::string>& lines) const {
    std::string open = typed_.kept().empty() ? "" : typed_.kept().front();
    for (const std::string& line : lines) {
        if (opens_buffer(line) && !open.empty()) {
            throw Error(second_open_message(line), {}, second_open_hint(open));
        }
        if (!open.empty() && !closes_buffer(line) && acts_at_once(line)) {
            throw Error(at_once_message(line), {}, at_once_hint);
        }
        open = opens_buffer(line) ? line : closes_buffer(line) ? "" : open;
    }
}

void PmacSession::keep_until_close(const std::vector<std::string>& lines) {
    typed_.keep(lines);
    const std::size_t count = typed_.kept().size() - 1;
    answer_.begin(drivers::CommandAnswer::State::done,
                  fmt::format("{}: {} {} kept until CLOSE",
                              typed_.kept().front(),
                              count,
                              count == 1 ? "line is" : "lines are"));
    tell(false, drivers::ConsoleKind::message, lines.back() + ": not yet sent; " + answer_.text);
}

int PmacSession::command(const std::vector<std::string>& given, bool all) {
    if (acted_on_key(given)) {
        return answer_.number;
    }
    const std::vector<std::string> parts = split_at_buffer_words(given);
    check_command(parts);
    check_open(parts);
    if (all && !typed_.kept().empty()) {
        throw Error(
            "a file cannot be loaded while a buffer is open", {}, second_open_hint(typed_.kept().front()));
    }
    const bool may_wait = !all && !answer_.pending();
    const std::size_t now = may_wait ? typed_.count_to_send(parts) : parts.size();
    if (now == 0) {
        keep_until_close(parts);
        return answer_.number;
    }
    const auto rest = parts.begin() + static_cast<std::ptrdiff_t>(now);
    const std::vector<std::string> typed(parts.begin(), rest);
    std::vector<std::string> lines = all ? typed : typed_.completed(typed);
    check_goals(lines);
    check_buffers(all ? parts : typed_.completed(parts));
    if (stopped_by_command(lines) || brakes_instead(lines)) {
        typed_.keep({rest, parts.end()});
        return answer_.number;
    }
    check_programs(lines, all);
    if (power_.plcs_run && are_all(lines, only_kills)) {
        lines.insert(lines.begin(), disable_plcs); // else they would give the power back
    }
    const bool waits = answer_.pending();
    const bool asks = are_all(lines, asks_or_disables_plcs);
    if (!asks && rests()) {
        give_jog_speeds_back();
    }
    const bool moves = stage_ == Stage::moving_by_command || (rests() && !standing());
    if (moves && !asks && are_all(lines, only_ends_motion)) {
        finish(Stage::commanding);
    } else if (stage_ == Stage::alarm && !waits && !link_lost() && are_all(lines, is_taken_in_alarm)) {
        // nothing has power: what a test of a motor had borrowed is given back
    } else if (waits || !asks || !(active() || moves) || stage_ == Stage::loading) {
        require_rest("a command");
        finish(Stage::commanding);
    }
    begin_command(lines, all);
    typed_.sent(typed);
    typed_.keep({rest, parts.end()});
    return answer_.number;
}

/// Behind a refused OPEN, whose lines would act at once. CLOSE is sent all the same: a card opens the buffer
/// before it refuses what stands behind its number.
void PmacSession::skip_buffer() {
    constexpr std::size_t named = 10;
    const auto close = std::ranges::find_if(command_.lines, closes_buffer);
    const std::vector<std::string> skipped(command_.lines.begin(), close);
    command_.lines.erase(command_.lines.begin(), close);
    if (command_.lines.empty()) {
        command_.lines.emplace_back("CLOSE");
    }
    for (std::size_t n = 0; n < std::min(named, skipped.size()); ++n) {
        answer_.text += fmt::format("\n'{}' is not executed: its buffer was not opened", skipped[n]);
    }
    if (skipped.size() == named + 1) {
        answer_.text += fmt::format("\n'{}' is not executed: its buffer was not opened", skipped.back());
    } else if (skipped.size() > named) {
        const std::size_t more = skipped.size() - named - 1;
        answer_.text += fmt::format("\n'{}' and the {} {} behind it, up to '{}', are not executed",
                                    skipped[named],
                                    more,
                                    more == 1 ? "line" : "lines",
                                    skipped.back());
    }
}

void PmacSession::begin_command(const std::vector<std::string>& lines, bool all) {
    answer_.begin();
    command_.goes_on = all;
    command_.refused = false;
    command_.lines.assign(lines.begin(), lines.end());
    command_.only_sets = std::all_of(lines.begin(), lines.end(), only_sets);
    watchdog_.stays_armed =
        watchdog_.stays_armed || std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
            return may_move_later(line, settings_.system);
        });
    bool stored = false;
    for (const std::string& line : lines) {
        stored = opens_buffer(line) || (stored && !closes_buffer(line));
        power_.plcs_run = power_.plcs_run || (!stored && enables_plc(line));
    }
    int addressed = 0;
    command_.closes_loops = false;
    for (const std::string& line : lines) {
        for (const PowerChange& change : power_changes_of(line, addressed)) {
            command_.closes_loops = command_.closes_loops || change.given;
            for (std::size_t n = 0; n < motors_.size() && change.given; ++n) {
                const bool other = change.motor && *change.motor != settings_.axes[n].motor;
                motors_[n].gets_power = motors_[n].gets_power || !other;
                motors_[n].was_given_power = motors_[n].was_given_power || !other;
            }
        }
    }
    power_.given = power_.given || command_.closes_loops || power_.plcs_run;
    command_.text.clear();
    for (const std::string& line : lines) {
        command_.text += line + "\n";
    }
    command_.from.clear();
    for (const MotorState& motor : motors_) {
        command_.from.push_back(motor.counts);
    }
    next_command();
}

} // namespace millwright::pmac::internal
