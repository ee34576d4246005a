// A program that the controller reads in its check mode ($C): nothing moves, and it says what it refuses.
#include "core/base/counted.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

ProgramLine check_mode_toggle(int block) {
    return {.text = "$C", .block = block};
}

/// Leaving check mode resets the controller. A line that brings back what was in force: plane, units,
/// distances, work system, kind of feed, and the feed.
std::string modes_line(std::string_view modes) {
    constexpr double mm_per_inch = 25.4;
    std::string line;
    double feed = 0.0; // mm/min
    while (!modes.empty()) {
        const std::string_view word = modes.substr(0, modes.find(' '));
        modes.remove_prefix(std::min(word.size() + 1, modes.size()));
        const bool is_motion = word == "G0" || word == "G1" || word == "G2" || word == "G3" ||
                               word == "G80" || word.starts_with("G38");
        if (word.starts_with('G') && !is_motion) {
            line += word;
        } else if (word.starts_with('F')) {
            feed = read_number(word.substr(1)).value_or(0.0);
        }
    }
    if (feed > 0.0 && line.find("G94") != std::string::npos) {
        line += "F" + shortest(line.find("G20") != std::string::npos ? feed / mm_per_inch : feed);
    }
    return line;
}

} // namespace

int GrblSession::check(ProgramLines program, double now) {
    require_rest("check");
    if (change_) {
        throw Error("a job is waiting for a tool change", {}, "resume it, or stop it");
    }
    for (const char* name : {"G92", "TLO"}) {
        const auto offset = readout_.offsets.find(name);
        if (offset != readout_.offsets.end() &&
            std::ranges::any_of(offset->second, [](double value) { return !exactly_equal(value, 0.0); })) {
            throw Error(fmt::format("{} of the controller is not zero and would be lost when the check ends",
                                    offset->first == "TLO" ? "the tool length offset" : "the G92 offset"),
                        {},
                        "set the zero of a work system instead (G10 L20), or run without this check");
        }
    }
    for (const ProgramLine& line : program.lines) {
        if (line.writes_eeprom) {
            throw Error(fmt::format("line {} stores an offset even in check mode: {}", line.line, line.text),
                        {},
                        "run without this check");
        }
    }
    check_.modes_before = modes_line(readout_.modes.text);
    check_.refused = 0;
    check_.lines = static_cast<int>(std::ssize(program.lines));
    answer_.begin();
    send_window_.begin(nullptr, program.blocks);
    program.lines.insert(program.lines.begin(), check_mode_toggle(0));
    program.lines.push_back(check_mode_toggle(std::max(0, program.blocks - 1)));
    begin(std::move(program), Activity::check, now);
    return answer_.number;
}

bool GrblSession::checks() const {
    return at_ == Activity::check && (stage_ == Stage::running || stage_ == Stage::braking);
}

/// The line that ends it was answered, and its greeting is to come.
bool GrblSession::leaves_check_mode() const {
    return at_ == Activity::check && stage_ == Stage::running && window_.empty() &&
           next_line_ == std::ssize(program_.lines);
}

void GrblSession::refused_in_check(const SentLine& line, const std::string& why, double now) {
    if (line.text == "$C\n") {
        fail(fmt::format("{} has no check mode: {}", name(), why), now);
        return;
    }
    constexpr int most_shown = 100;
    const ProgramLine& of = program_.lines[static_cast<std::size_t>(line.index)];
    if (++check_.refused <= most_shown) {
        answer_.add_line(fmt::format("line {}: {}: {}", of.line, why, of.text));
    }
    if (facts().errors_stick) { // it refuses every line from here on
        next_line_ = std::max(next_line_, static_cast<int>(std::ssize(program_.lines)) - 1);
    }
}

/// It was reset, and is asked what is in force now.
void GrblSession::finish_check(double now) {
    window_.clear();
    const bool all_read = check_.refused == 0;
    answer_.state = all_read ? CommandAnswer::State::done : CommandAnswer::State::refused;
    if (all_read) {
        answer_.text =
            fmt::format("{} read {} in check mode without errors", name(), counted(check_.lines, "line"));
    }
    overrides_.forget();
    ask_again(Stage::ready, now, check_.modes_before);
}

} // namespace millwright::drivers::grbl
