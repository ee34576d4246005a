#include "core/jobs/tool_check.h"

#include "core/base/text.h"
#include "core/drivers/mdi_lines.h"
#include "core/gcode/tool_comments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace millwright::jobs {

namespace {

/// A word of a line as it is written, outside of comments.
struct WrittenWord {
    char letter = ' ';
    double value = 0.0;
    std::size_t begin = 0, end = 0; ///< columns, from 0
};

std::size_t end_of_comment(std::string_view line, std::size_t at) {
    return line[at] == ';' ? line.size() : std::min(line.find(')', at), line.size());
}

std::vector<WrittenWord> written_words(std::string_view line) {
    std::vector<WrittenWord> words;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (line[at] == ';' || line[at] == '(') {
            at = end_of_comment(line, at);
            continue;
        }
        const auto c = static_cast<unsigned char>(line[at]);
        if (std::isalpha(c) == 0) {
            continue;
        }
        const std::size_t number = std::min(line.find_first_not_of(" \t", at + 1), line.size());
        WrittenWord word{static_cast<char>(std::toupper(c)), 0.0, at, at + 1};
        const char* const end = line.data() + line.size();
        const auto read = std::from_chars(line.data() + number, end, word.value, std::chars_format::fixed);
        if (read.ec == std::errc{} && std::isfinite(word.value)) {
            word.end = static_cast<std::size_t>(read.ptr - line.data());
            words.push_back(word);
            at = word.end - 1;
        }
    }
    return words;
}

bool is_code(const WrittenWord& word, char letter, double value) {
    constexpr double same = 1e-6;
    return word.letter == letter && std::abs(word.value - value) < same;
}

/// The text of a line's comments.
std::string comment_of(std::string_view line) {
    std::string text;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (line[at] == ';' || line[at] == '(') {
            const std::size_t end = end_of_comment(line, at);
            text += (text.empty() ? "" : " ") + std::string(line.substr(at + 1, end - at - 1));
            at = end;
        }
    }
    constexpr std::size_t longest = 60;
    const std::size_t first = std::min(text.find_first_not_of(" \t\r"), text.size());
    const std::size_t last = std::min(text.find_last_not_of(" \t\r") + 1, text.size());
    return text.substr(first, std::min(longest, last - std::min(first, last)));
}

std::vector<std::string_view> lines_of_text(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

int tool_number(double value) {
    constexpr double most = 1e6;
    return static_cast<int>(std::lround(std::clamp(value, 0.0, most)));
}

/// "6 mm" where no comment of the tool is to be found.
std::string name_of(const ToolCall& call,
                    const std::vector<std::string_view>& lines,
                    const std::vector<gcode::CommentTool>& comments) {
    const std::string own = comment_of(lines[static_cast<std::size_t>(call.line) - 1]);
    const auto known =
        std::ranges::find(comments, std::optional(call.tool), [](const auto& tool) { return tool.number; });
    if (!own.empty() || known == comments.end()) {
        return own;
    }
    return comment_of(lines[static_cast<std::size_t>(known->line) - 1]);
}

std::string sentence_of(const ToolCall& call) {
    const std::string tool = call.tool > 0 ? fmt::format("change to tool {}", call.tool) : "change the tool";
    return fmt::format(
        "{} at line {}: M6{}", tool, call.line, call.name.empty() ? "" : " (" + call.name + ")");
}

std::vector<int> stop_lines(const std::vector<ToolCall>& calls) {
    std::vector<int> lines;
    for (const ToolCall& call : calls) {
        if (!call.again) {
            lines.push_back(call.line);
        }
    }
    return lines;
}

/// Collects the faults of the tool changes of one job.
class Faults {
public:
    Faults(const Job& job, const ToolChangePlace& place) : job_(job), place_(place) {}

    std::vector<Diagnostic> take() { return std::move(found_); }
    void add(int line, std::string sentence, std::string hint = {}) {
        found_.push_back({{job_.project, line, 0, -1}, std::move(sentence), std::move(hint)});
    }

    void check_machine() {
        if (place_.laser) {
            add(0,
                "the controller is in laser mode ($32=1), so moves to and from a tool change could burn",
                "set $32=0 for a spindle");
        }
        const bool by_machine_zero = job_.tool_change->way == drivers::ToolChangeWay::probe;
        if (!place_.status.position_doubt.empty() && (place_.status.position_lost || by_machine_zero)) {
            add(0,
                "returning from a tool change needs a verified position: " + place_.status.position_doubt,
                "home the machine, or confirm the reported position");
        }
        if (place_.status.modes.empty()) {
            add(0,
                "the controller does not report its modes ($G), so they cannot be restored after a tool "
                "change");
        }
        for (const drivers::StoredOffset& offset : place_.offsets) {
            if (offset.name == "TLO" && offset.value.size() > 2 && std::abs(offset.value[2]) > 0.0) {
                add(0,
                    fmt::format("a tool length offset of {:.3f} mm from an earlier tool is active",
                                offset.value[2]),
                    "cancel it with G49, and set the Z zero for the tool in the spindle");
            }
        }
    }

    void check_lines(const ProgramCheck& found) {
        for (const ProgramCheck::Before& before : found.watched) {
            const int motion = before.modes.motion;
            constexpr int clockwise = 20;
            constexpr int none = 800;
            if (before.modes.distance == gcode::DistanceMode::incremental) {
                add(before.line,
                    "G91 is active at this tool change: the next line would count from wherever the machine "
                    "is then",
                    "put G90 before the M6");
            }
            if (motion >= clockwise && motion != none) {
                add(before.line,
                    "an arc or probing motion is active at this tool change and cannot be restored without a "
                    "move",
                    "put G0 or G1 before the M6");
            }
            const double start = found.start[2].value_or(before.z.min);
            const bool went_up = before.z.max > start || before.knows_height;
            if (!before.z.empty() && !went_up) {
                add(before.line,
                    "the program has not raised Z before this tool change: no safe height for the return is "
                    "known",
                    "raise Z (G0 Z) before the M6, or change the first tool before any move");
            }
        }
    }

    void check_sensor(const drivers::ToolSensor& sensor, std::string_view text) {
        if (!(sensor.travel_z > sensor.deepest_z)) {
            add(0, "the lowest Z of the tool sensor search is not below the travel height");
        }
        if (!(sensor.feed > 0.0)) {
            add(0, "the tool sensor search needs a feed rate");
        }
        constexpr double unset = 1e-9;
        if (std::abs(sensor.x) < unset && std::abs(sensor.y) < unset) {
            add(0,
                "the position of the tool sensor is not set (it is X0 Y0)",
                "set its X and Y in machine coordinates");
        }
        check_reach('X', sensor.x);
        check_reach('Y', sensor.y);
        check_reach('Z', sensor.travel_z);
        check_reach('Z', sensor.deepest_z);
        int number = 0;
        for (const std::string_view line : lines_of_text(text)) {
            ++number;
            if (number < job_.from_line) {
                continue; // the approach, which cancels a length
            }
            for (const WrittenWord& word : written_words(line)) {
                if (is_code(word, 'G', 43.0) || is_code(word, 'G', 43.1) || is_code(word, 'G', 43.2) ||
                    is_code(word, 'G', 49.0)) {
                    add(number,
                        "the program sets a tool length, and so does the tool sensor",
                        "remove it from the program, or choose another way to change tools");
                    return;
                }
            }
        }
    }

    /// Whether it is a program that can be sent in the middle of another.
    void check_macro(const drivers::ToolChangePlan& plan, const drivers::Capabilities& able) {
        const std::string file = plan.macro_file.empty() ? "macro" : plan.macro_file;
        int number = 0;
        bool empty = true;
        for (const std::string_view line : lines_of_text(plan.macro)) {
            ++number;
            for (const WrittenWord& word : written_words(line)) {
                empty = false;
                if (is_code(word, 'M', 6.0) || is_code(word, 'M', 2.0) || is_code(word, 'M', 30.0)) {
                    found_.push_back(
                        {{file, number, static_cast<int>(word.begin) + 1, -1},
                         fmt::format("the tool change macro contains M{:.0f}", word.value),
                         "remove it; a tool change macro must not change tools or end the program"});
                }
            }
        }
        if (empty) {
            found_.push_back({{file}, "the tool change macro is empty", {}});
        }
        const ProgramCheck read = check_program(plan.macro,
                                                file,
                                                {.dialect = able.dialect.value_or(gcode::Dialect::grbl),
                                                 .axes = able.axes,
                                                 .start = {},
                                                 .offsets = place_.offsets,
                                                 .modes = "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0",
                                                 .mist = able.mist,
                                                 .firmware = able.firmware});
        const std::vector<Diagnostic> faults = faults_of(read, place_.limits, file);
        found_.insert(found_.end(), faults.begin(), faults.end());
    }

private:
    const Job& job_;
    const ToolChangePlace& place_;
    std::vector<Diagnostic> found_;

    void check_reach(char letter, double value) {
        const auto axis =
            std::ranges::find(place_.limits.axes, letter, &drivers::MachineLimits::Axis::letter);
        if (axis == place_.limits.axes.end() || !axis->min || !axis->max) {
            add(0,
                fmt::format("the tool sensor needs a machine that homes, but the travel of {} is unknown",
                            letter),
                "enable homing ($22), or change tools without the sensor");
        } else if (!(value >= *axis->min && value <= *axis->max)) {
            add(0,
                fmt::format("the tool sensor's {} {:.3f} is outside {:.3f} ... {:.3f} (machine coordinates)",
                            letter,
                            value,
                            *axis->min,
                            *axis->max));
        }
    }
};

} // namespace

std::vector<ToolCall> tool_calls(std::string_view text) {
    const std::vector<std::string_view> lines = lines_of_text(text);
    std::vector<ToolCall> calls;
    std::optional<std::vector<gcode::CommentTool>> comments;
    int selected = 0;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        int column = 0;
        for (const WrittenWord& word : written_words(lines[n])) {
            selected = word.letter == 'T' ? tool_number(word.value) : selected;
            column = is_code(word, 'M', 6.0) ? static_cast<int>(word.begin) + 1 : column;
        }
        if (column > 0) {
            comments = comments ? std::move(comments) : gcode::tools_in_comments(text);
            ToolCall call{.line = static_cast<int>(n) + 1,
                          .column = column,
                          .tool = selected,
                          .again = false,
                          .name = {}};
            call.again = selected > 0 && !calls.empty() && calls.back().tool == selected;
            call.name = name_of(call, lines, *comments);
            calls.push_back(std::move(call));
        }
    }
    return calls;
}

std::string without_tool_changes(std::string_view text) {
    std::string result(text);
    std::size_t start = 0;
    for (const std::string_view line : lines_of_text(text)) {
        for (const WrittenWord& word : written_words(line)) {
            if (is_code(word, 'M', 6.0)) {
                std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(start + word.begin),
                            word.end - word.begin,
                            ' ');
            }
        }
        start += line.size() + 1;
    }
    return result;
}

std::string controller_text(const Job& job) {
    return job.tool_change ? without_tool_changes(job.listing->text) : job.listing->text;
}

std::vector<int> watched_lines(const Job& job) {
    return job.tool_change ? stop_lines(tool_calls(job.listing->text)) : std::vector<int>();
}

drivers::ToolChanges tool_changes(const Job& job, const ProgramCheck& found) {
    expects(job.tool_change.has_value(), "the job has tool changes of its own");
    drivers::ToolChanges changes{.plan = *job.tool_change, .stops = {}};
    for (const ToolCall& call : tool_calls(job.listing->text)) {
        if (call.again) {
            changes.same_tool.push_back(call.line);
            continue;
        }
        drivers::ToolStop stop{call.line, call.tool, sentence_of(call)};
        const auto before = std::ranges::find(found.watched, call.line, &ProgramCheck::Before::line);
        if (before != found.watched.end() && !before->z.empty()) {
            stop.program_z = before->z.max;
            stop.highest_z = std::max(before->z.max, found.start[2].value_or(before->z.max));
        }
        changes.stops.push_back(std::move(stop));
    }
    const bool moves_before = !changes.stops.empty() && changes.stops.front().highest_z.has_value();
    const bool by_sensor = changes.plan.way == drivers::ToolChangeWay::probe;
    changes.reference_first = by_sensor && moves_before;
    changes.needs_zero = by_sensor && (moves_before || job.tool_at_start.has_value());
    return changes;
}

std::vector<Diagnostic> tool_change_faults(const Job& job,
                                           const ProgramCheck& found,
                                           const drivers::Capabilities& able,
                                           const ToolChangePlace& place) {
    if (!job.tool_change || tool_calls(job.listing->text).empty()) {
        return {};
    }
    Faults faults(job, place);
    if (!able.program.tool_changes) {
        faults.add(0, "the controller of this machine changes tools itself", "omit the option");
        return faults.take();
    }
    faults.check_machine();
    faults.check_lines(found);
    if (job.tool_change->way == drivers::ToolChangeWay::probe) {
        faults.check_sensor(job.tool_change->sensor, job.listing->text);
    } else if (job.tool_change->way == drivers::ToolChangeWay::macro) {
        faults.check_macro(*job.tool_change, able);
    }
    return faults.take();
}

std::string tool_before_start(const Job& job, const ProgramCheck& found) {
    if (!job.tool_change) {
        return {};
    }
    const drivers::ToolChanges changes = tool_changes(job, found);
    if (!job.tool_at_start && !changes.reference_first) {
        return {};
    }
    const std::string measured = changes.reference_first ? ": it is measured first" : "";
    if (!job.tool_at_start) {
        return fmt::format("The tool with which the Z zero was set must be in the spindle{}.", measured);
    }
    const std::string tool = *job.tool_at_start > 0
                                 ? fmt::format("Tool {}", *job.tool_at_start)
                                 : "The tool of the earlier lines, which the program does not name,";
    return fmt::format("{} must be in the spindle at line {}, and the Z zero must be set with it{}.",
                       tool,
                       job.from_line,
                       measured);
}

} // namespace millwright::jobs
