#include "core/pmac/emulator/motion_program.h"

#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/guard_rules.h"
#include "core/pmac/driver/pmac_file.h"
#include "core/pmac/emulator/internal/stored_program.h"
#include "core/pmac/emulator/pmac_emulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace millwright::pmac {

namespace {

using card::Statement;
using card::Verb;

Diagnostic at_line(const std::filesystem::path& named, int line, std::string message, std::string hint = {}) {
    return {.place = {.file = named, .line = line}, .message = std::move(message), .hint = std::move(hint)};
}

/// Every condition and loop has its end.
class Blocks {
public:
    explicit Blocks(const std::filesystem::path& named) : named_(named) {}

    void take(const Statement& one, int line, std::vector<Diagnostic>& faults) {
        if (one.verb == Verb::if_true || one.verb == Verb::while_true) {
            open_.push_back({one.verb, line});
        } else if (one.verb == Verb::end_if || one.verb == Verb::end_while) {
            const Verb begin = one.verb == Verb::end_if ? Verb::if_true : Verb::while_true;
            if (open_.empty() || open_.back().verb != begin) {
                faults.push_back(at_line(named_, line, "this does not end any open block"));
            } else {
                open_.pop_back();
            }
        } else if (one.verb == Verb::otherwise && (open_.empty() || open_.back().verb != Verb::if_true)) {
            faults.push_back(at_line(named_, line, "this ELSE has no matching IF"));
        }
    }
    void end(std::vector<Diagnostic>& faults) const {
        for (const Begin& one : open_) {
            faults.push_back(at_line(named_,
                                     one.line,
                                     one.verb == Verb::if_true ? "this IF has no matching ENDIF"
                                                               : "this WHILE has no matching ENDWHILE"));
        }
    }

private:
    struct Begin {
        Verb verb;
        int line;
    };
    const std::filesystem::path& named_;
    std::vector<Begin> open_;
};

std::string why_none(std::string_view line) {
    const auto words = card::words_of(line);
    const auto is_of_buffers = [](const card::Token& token) {
        return token.text == "OPEN" || token.text == "CLOSE" || token.text == "CLEAR";
    };
    return words && std::ranges::any_of(*words, is_of_buffers) ? buffer_word_hint : "";
}

/// The card with the axes of the settings, at rest where they begin.
class Bench {
public:
    explicit Bench(const MotionSimulationSettings& settings)
        : settings_(settings), card_({.plants = {}, .channels = 8}) {
        say("I6=1");
        for (std::size_t n = 0; n < settings.card.axes.size(); ++n) {
            const PmacAxis& axis = settings.card.axes[n];
            say(fmt::format("I{}00=1", axis.motor));
            say(fmt::format(
                "&{}#{}->{}{}", settings.card.system, axis.motor, axis.counts_per_degree, axis.letter));
            say(fmt::format("#{}J/", axis.motor));
        }
        card_.advance(0.1);
        for (std::size_t n = 0; n < settings.card.axes.size(); ++n) {
            const double at = n < settings.start_deg.size() ? settings.start_deg[n] : 0.0;
            const PmacAxis& axis = settings.card.axes[n];
            say(fmt::format("#{}HMZ", axis.motor));
            say(fmt::format("#{}J={:.0f}", axis.motor, at * axis.counts_per_degree));
        }
        constexpr double glance = 0.05, longest = 600.0;
        for (double t = 0.0; t < longest && (t < 1.0 || card_.moving()); t += glance) {
            card_.advance(glance);
        }
    }

    /// "" or the card's number of the error.
    std::string say(const std::string& line) {
        card_.receive(line + "\r");
        const std::string answer = card_.take_output();
        const std::size_t error = answer.find("ERR");
        return error == std::string::npos ? std::string() : answer.substr(error + 3, 3);
    }
    void advance(double seconds) { card_.advance(seconds); }
    [[nodiscard]] bool runs() const { return card_.program_runs(settings_.card.system); }
    [[nodiscard]] bool moves() const { return card_.moving(); }
    [[nodiscard]] MotionRecord record(double time) const {
        MotionRecord record{time};
        for (const PmacAxis& axis : settings_.card.axes) {
            record.degrees.push_back(card_.command(axis.motor) / axis.counts_per_degree);
        }
        return record;
    }
    /// The card ended the program without a command from us.
    [[nodiscard]] bool broke_off() {
        card_.receive(fmt::format("&{}??\r", settings_.card.system));
        const std::string answer = card_.take_output();
        constexpr std::size_t half = 6;
        constexpr int hexadecimal = 16;
        constexpr std::uint32_t errors = 3U << 21;
        const std::size_t begin = answer.find_first_of("0123456789ABCDEF");
        if (begin == std::string::npos || answer.size() < begin + 2 * half) {
            return true;
        }
        std::uint32_t word = 0;
        const char* const text = answer.data() + begin + half;
        return std::from_chars(text, text + half, word, hexadecimal).ec != std::errc{} ||
               (word & errors) != 0;
    }

private:
    const MotionSimulationSettings& settings_;
    PmacEmulator card_;
};

bool load(Bench& bench,
          const std::vector<MotionLine>& lines,
          const std::filesystem::path& named,
          std::vector<Diagnostic>& faults) {
    (void)bench.say("OPEN PROG 1 CLEAR");
    for (const MotionLine& line : lines) {
        if (const std::string error = bench.say(line.text); !error.empty()) {
            int number = 0;
            (void)std::from_chars(error.data(), error.data() + error.size(), number);
            faults.push_back(at_line(named, line.number, std::string(pmac_error(number))));
        }
    }
    if (const std::string error = bench.say("CLOSE"); !error.empty()) {
        faults.push_back(at_line(named, 0, "a loop or a condition is not closed"));
    }
    return faults.empty();
}

std::optional<Diagnostic> beyond_limits(const MotionRecord& record,
                                        const MotionRecord& before,
                                        const PmacSettings& card,
                                        const std::filesystem::path& named) {
    constexpr double slack_deg = 0.05; // counts are rounded
    const std::vector<PmacAxis>& axes = card.axes;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const double at = record.degrees[n];
        const bool above = axes[n].max_deg && at > *axes[n].max_deg + slack_deg && at > before.degrees[n];
        const bool below = axes[n].min_deg && at < *axes[n].min_deg - slack_deg && at < before.degrees[n];
        if (above || below) {
            const std::string joint =
                card.arm ? " (joint " + card.arm->joint(static_cast<int>(n)).name + ")" : std::string();
            return at_line(named,
                           0,
                           fmt::format("{}{} exceeds its limits after {:.1f} s: it ends at {:.4g} degrees",
                                       axes[n].letter,
                                       joint,
                                       record.time,
                                       above ? *axes[n].max_deg : *axes[n].min_deg));
        }
    }
    constexpr double slack_mm = 0.5; // a count is as much at the end of a long arm
    if (const std::string why = leaves_zone(card, before.degrees, record.degrees, slack_mm); !why.empty()) {
        return at_line(named, 0, fmt::format("after {:.1f} s {}", record.time, why));
    }
    return std::nullopt;
}

/// To its end, or to where an axis leaves its limits. "", or the card's error where it does not begin.
std::string run(Bench& bench,
                const std::filesystem::path& named,
                const MotionSimulationSettings& settings,
                const Progress& progress,
                MotionSimulation& result) {
    result.records.push_back(bench.record(0.0));
    if (std::string error = bench.say(fmt::format("&{}B1R", settings.card.system)); !error.empty()) {
        return error;
    }
    double& time = result.duration;
    do {
        progress.check();
        bench.advance(settings.step);
        time += settings.step;
        result.records.push_back(bench.record(time));
        result.beyond_limits = beyond_limits(
            result.records.back(), result.records[result.records.size() - 2], settings.card, named);
    } while (!result.beyond_limits && (bench.runs() || bench.moves()) && time < settings.longest);
    return {};
}

/// Where a program may be cut off: behind these many lines no loop and no condition is open.
std::vector<std::size_t> whole_beginnings(const std::vector<MotionLine>& lines) {
    std::vector<std::size_t> ends;
    int depth = 0;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const auto words = card::words_of(lines[n].text);
        for (const Statement& one : words ? card::compile(*words, false).value_or(std::vector<Statement>{})
                                          : std::vector<Statement>{}) {
            const bool begins = one.verb == Verb::if_true || one.verb == Verb::while_true;
            const bool ends_one = one.verb == Verb::end_if || one.verb == Verb::end_while;
            depth += begins ? 1 : ends_one ? -1 : 0;
        }
        if (depth == 0) {
            ends.push_back(n + 1);
        }
    }
    return ends;
}

/// The card looks ahead, so its program counter does not tell whose move it was: the last line, or loop, of
/// the shortest beginning of the program that leaves the limits. 0 where that would take too long.
int line_beyond_limits(const std::vector<MotionLine>& lines,
                       const std::filesystem::path& named,
                       MotionSimulationSettings settings,
                       double found_after,
                       const Progress& progress) {
    constexpr double longest_search = 300.0; // s of the card's time
    constexpr double behind = 5.0;           // s: without the next move it may come there later, as it brakes
    const std::vector<std::size_t> ends = whole_beginnings(lines);
    settings.longest = found_after + behind;
    std::size_t first = 0, last = ends.size(); // ends[last - 1] lines leave them
    for (double spent = 0.0; last - first > 1; spent += settings.longest) {
        if (spent > longest_search) {
            return 0;
        }
        const std::size_t middle = first + (last - first) / 2;
        const auto count = static_cast<std::ptrdiff_t>(ends[middle - 1]);
        Bench bench(settings);
        MotionSimulation result;
        (void)load(bench, {lines.begin(), lines.begin() + count}, named, result.faults);
        (void)run(bench, named, settings, progress, result);
        (result.beyond_limits ? last : first) = middle;
    }
    const std::size_t begin = last > 1 ? ends[last - 2] : 0;
    return lines[begin].number;
}

} // namespace

std::vector<MotionLine> motion_lines(std::string_view text, const std::filesystem::path& named) {
    std::vector<MotionLine> lines;
    for (const PmacFile::Line& line : read_pmac_program(text, named)) {
        lines.push_back({line.number, line.text});
    }
    return lines;
}

std::vector<Diagnostic> motion_program_faults(std::string_view text, const std::filesystem::path& named) {
    std::vector<Diagnostic> faults;
    std::vector<MotionLine> lines;
    try {
        lines = motion_lines(text, named);
    } catch (const Error& error) {
        return {error.diagnostic()};
    }
    Blocks blocks(named);
    for (const MotionLine& line : lines) {
        const auto words = card::words_of(line.text);
        const auto statements = words ? card::compile(*words, false) : std::nullopt;
        if (!statements) {
            faults.push_back(at_line(named,
                                     line.number,
                                     fmt::format("'{}' is not a line of a motion program", line.text),
                                     why_none(line.text)));
            continue;
        }
        for (const Statement& one : *statements) {
            blocks.take(one, line.number, faults);
        }
        if (const std::string why = guard_refusal(line.text); !why.empty()) {
            faults.push_back(at_line(
                named,
                line.number,
                fmt::format("'{}' would weaken the guard that stops the motors when the connection is lost",
                            line.text),
                why));
        } else if (sets_handshake(line.text)) {
            faults.push_back(
                at_line(named,
                        line.number,
                        fmt::format("'{}' would change the handshake, which is controlled by the driver",
                                    line.text)));
        }
    }
    blocks.end(faults);
    std::ranges::stable_sort(faults, {}, [](const Diagnostic& one) { return one.place.line; });
    return faults;
}

jobs::Job motion_program_job(std::string_view text, const std::filesystem::path& named) {
    if (const auto faults = motion_program_faults(text, named); !faults.empty()) {
        throw Error(faults.front());
    }
    std::string lines; // at their places, so that a fault has the line of the file
    int line = 1;
    for (const MotionLine& one : motion_lines(text, named)) {
        lines.append(static_cast<std::size_t>(one.number - line), '\n');
        lines += one.text;
        line = one.number;
    }
    return jobs::text_job(std::move(lines), named);
}

MotionSimulation simulate_motion_program(std::string_view text,
                                         const std::filesystem::path& named,
                                         const MotionSimulationSettings& settings,
                                         const Progress& progress) {
    expects(settings.step > 0.0 && settings.longest > 0.0, "a step and an end of time");
    MotionSimulation result;
    result.faults = motion_program_faults(text, named);
    const std::vector<MotionLine> lines =
        result.faults.empty() ? motion_lines(text, named) : std::vector<MotionLine>{};
    if (lines.empty()) {
        return result;
    }
    Bench bench(settings);
    if (!load(bench, lines, named, result.faults)) {
        return result;
    }
    if (const std::string error = run(bench, named, settings, progress, result); !error.empty()) {
        result.faults.push_back(
            at_line(named, lines.front().number, "the card does not start it: ERR" + error));
        return result;
    }
    if (result.beyond_limits) {
        result.beyond_limits->place.line =
            line_beyond_limits(lines, named, settings, result.duration, progress);
        result.faults.push_back(*result.beyond_limits);
    } else if (bench.broke_off()) {
        result.faults.push_back(at_line(named, 0, "the card ends the program with a run-time error"));
    } else if (bench.runs()) {
        result.faults.push_back(
            at_line(named,
                    0,
                    fmt::format("the program is still running after {:.0f} s: check that it ends",
                                settings.longest)));
    }
    return result;
}

} // namespace millwright::pmac
