#include "core/jobs/run_from_line.h"

#include "core/base/counted.h"
#include "core/drivers/modal_lines.h"
#include "core/drivers/stripped_line.h"
#include "core/gcode/interpreter.h"
#include "core/jobs/internal/program_from_line.h"
#include "core/jobs/tool_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace millwright::jobs {

namespace {

using drivers::has_code;
using gcode::AxisValues;
using gcode::Command;
using gcode::CommandKind;
using gcode::Dialect;
using gcode::ModalState;
using gcode::Move;
using gcode::MoveKind;

constexpr int z_axis = 2;

[[noreturn]] void
refuse_start(const std::filesystem::path& file, int line, std::string why, std::string hint = {}) {
    throw Error(Diagnostic{{file, line, 0, -1}, std::move(why), std::move(hint)});
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// Flow that makes "the lines before" mean something else than the lines above.
void check_flow(const std::vector<std::string_view>& lines, const std::filesystem::path& file) {
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const std::string text = drivers::stripped_line(lines[n]);
        const int number = static_cast<int>(n) + 1;
        if (drivers::is_flow(text)) {
            refuse_start(file, number, "a program with subroutines or loops cannot be started in the middle");
        }
        if (text.find('#') != std::string::npos) {
            refuse_start(file, number, "a program with parameters cannot be started in the middle");
        }
        if (text.find("G38.") != std::string::npos) {
            refuse_start(file, number, "a program that probes cannot be started in the middle");
        }
    }
}

/// G53, G28 and G30 go to machine positions, of which a program does not know the work coordinates.
bool goes_by_the_machine(std::string_view stripped_line) {
    return has_code(stripped_line, "G53") || has_code(stripped_line, "G28") || has_code(stripped_line, "G30");
}

/// The axes whose work coordinates the lines tell.
class KnownAxes {
public:
    void take(std::string_view stripped_line, bool incremental) {
        if (goes_by_the_machine(stripped_line)) {
            known_.fill(false);
            left_ = true;
            return;
        }
        for (std::size_t n = 0; n < known_.size() && !incremental; ++n) {
            known_[n] = known_[n] || stripped_line.find(gcode::axis_letters[n]) != std::string_view::npos;
        }
    }
    /// '\0': all.
    [[nodiscard]] char unknown() const {
        const auto* found = std::ranges::find(known_, false);
        return found == known_.end() ? '\0'
                                     : gcode::axis_letters[static_cast<std::size_t>(found - known_.begin())];
    }

    /// Whether the lines went to a machine position.
    [[nodiscard]] bool left() const { return left_; }

private:
    std::array<bool, 3> known_{}; ///< X Y Z: the position at the start is not recorded
    bool left_ = false;
};

double mm_of(gcode::LengthUnit unit) {
    return unit == gcode::LengthUnit::mm ? 1.0 : gcode::mm_per_inch;
}

/// Watches the lines that are left out.
class Watcher final : public gcode::CanonSink {
public:
    void move(const Move& move, const gcode::SourceLine& now) override {
        const double z = move.target[gcode::Axis::z];
        if (move.kind == MoveKind::traverse && !goes_by_the_machine(drivers::stripped_line(now.text))) {
            highest_ = std::max(highest_.value_or(z), z);
        }
        const bool straight_down = z < here_[gcode::Axis::z] &&
                                   std::abs(move.target[gcode::Axis::x] - here_[gcode::Axis::x]) <= 0.0 &&
                                   std::abs(move.target[gcode::Axis::y] - here_[gcode::Axis::y]) <= 0.0;
        if (move.kind == MoveKind::feed && straight_down && by_the_minute_ && feed_ > 0.0) {
            plunge_ = feed_;
        }
        here_ = move.target;
    }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const Command& command, const gcode::SourceLine&) override {
        const bool frame = command.kind == CommandKind::set_g5x_offset ||
                           command.kind == CommandKind::set_g92_offset ||
                           command.kind == CommandKind::use_tool_length_offset;
        if (frame) {
            highest_.reset(); // Z means something else from here on
        }
        switch (command.kind) {
        case CommandKind::change_tool:
            changed_ = true;
            break;
        case CommandKind::set_feed_rate:
            feed_ = command.value;
            break;
        case CommandKind::set_feed_mode:
            by_the_minute_ = command.index != 1; // that of G93 is given as a feed per minute, too
            break;
        case CommandKind::use_length_units:
            use(static_cast<gcode::LengthUnit>(command.index));
            break;
        default:
            break;
        }
    }

    [[nodiscard]] std::optional<double> highest() const { return highest_; }
    /// The feed per minute of the last way straight down.
    [[nodiscard]] std::optional<double> plunge() const { return plunge_; }
    [[nodiscard]] bool changed_tool() const { return changed_; }

private:
    void use(gcode::LengthUnit unit) {
        const double factor = mm_of(unit_) / mm_of(unit);
        for (std::optional<double>* length : {&highest_, &plunge_}) {
            *length = *length ? std::optional(**length * factor) : std::nullopt;
        }
        unit_ = unit;
    }

    // Both in the unit in force.
    std::optional<double> highest_; ///< Z of a rapid
    std::optional<double> plunge_;
    gcode::LengthUnit unit_ = gcode::LengthUnit::mm;
    AxisValues here_{};
    double feed_ = 0.0;
    bool by_the_minute_ = true;
    bool changed_ = false;
};

/// What is in force before `line` is executed.
ModalState state_before(
    std::string_view text, const std::filesystem::path& file, int line, Dialect dialect, Watcher& watcher) {
    gcode::ReaderSettings settings;
    settings.dialect = dialect;
    settings.any_tool = true;
    settings.grbl_axes = "XYZABCUVW"; // what the controller has, it is asked before the rest is sent
    gcode::Interpreter reader(text, file, std::move(settings), watcher);
    const std::vector<std::string_view> lines = lines_of(text);
    KnownAxes known;
    for (int next = 1; next < line; ++next) {
        const bool more = reader.step();
        const std::string words = drivers::stripped_line(lines[static_cast<std::size_t>(next) - 1]);
        known.take(words, reader.state().distance == gcode::DistanceMode::incremental);
        if (has_code(words, "G10") || has_code(words, "G92") || has_code(words, "G52")) {
            refuse_start(file,
                         next,
                         "earlier lines change offsets (G10, G52, G92)",
                         "run the program from the beginning");
        }
        if (!reader.errors().empty()) {
            throw Error(reader.errors().front());
        }
        if (!more) {
            refuse_start(file, line, fmt::format("the program ends at line {}", reader.place().line));
        }
    }
    if (const char axis = known.unknown(); axis != '\0') {
        refuse_start(file,
                     line,
                     known.left() ? fmt::format("earlier lines move to a machine position (G53, G28, G30), "
                                                "and {} is not specified afterwards",
                                                axis)
                                  : fmt::format("no earlier line specifies {} (with G90), so the position of "
                                                "the machine at this line is unknown",
                                                axis),
                     "start a few lines later, or run the program from the beginning");
    }
    return reader.state();
}

void check_state(const ModalState& state,
                 std::string_view first_line,
                 const std::filesystem::path& file,
                 int line) {
    constexpr int first_cycle = 730;
    constexpr int no_motion = 800;
    constexpr int last_cycle = 890;
    if (state.cutter.on()) {
        refuse_start(file, line, "cutter compensation is active here (G41, G42)", "start where it is off");
    }
    if (state.motion >= first_cycle && state.motion <= last_cycle && state.motion != no_motion) {
        refuse_start(file, line, "a canned cycle is active here", "start at its first line, or after G80");
    }
    if (state.spindle_mode == gcode::SpindleMode::constant_surface_speed) {
        refuse_start(file, line, "constant surface speed is active here (G96)");
    }
    const std::string text = drivers::stripped_line(first_line);
    const bool straight = state.motion == 0 || state.motion == 10 || state.motion == no_motion;
    const bool names_motion = text.find('G') != std::string::npos;
    if (!straight && !names_motion) {
        refuse_start(
            file, line, "the line continues an arc or a spline", "start at a line that specifies its motion");
    }
}

/// In one line: all of these are of different modal groups.
std::string modes_line(const ModalState& state, Dialect dialect) {
    ModalState absolute = state;
    absolute.distance = gcode::DistanceMode::absolute;
    std::string text = drivers::modal_lines(absolute, dialect);
    std::string line;
    for (const char c : text) {
        line += c == '\n' ? ' ' : c;
    }
    line.pop_back();
    return line;
}

std::string tool_words(const ModalState& state, const Watcher& watcher, Dialect dialect) {
    if (state.selected_tool <= 0) {
        return {};
    }
    const bool changes = dialect == Dialect::linuxcnc && watcher.changed_tool();
    return fmt::format(" T{}{}", state.selected_tool, changes ? " M6" : "");
}

/// Whether one of the `lines` before has sent the axis somewhere.
bool sends_axis(std::span<const std::string_view> lines, char letter) {
    return std::ranges::any_of(lines, [letter](std::string_view line) {
        const std::string words = drivers::stripped_line(line);
        for (std::size_t at = words.find(letter); at != std::string::npos; at = words.find(letter, at + 1)) {
            constexpr std::string_view number = "0123456789.+-";
            if (at + 1 < words.size() && number.find(words[at + 1]) != std::string_view::npos) {
                return true;
            }
        }
        return false;
    });
}

/// All but Z. An axis beyond Z goes to zero, too, where a line before has sent it there.
std::string across(const ModalState& state, std::span<const std::string_view> lines) {
    std::string words = "G0";
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const bool named =
            n < 3 || std::abs(state.position[n]) > 0.0 || sends_axis(lines, gcode::axis_letters[n]);
        if (n != z_axis && named) {
            words += " " + drivers::number_word(gcode::axis_letters[n], state.position[n]);
        }
    }
    return words;
}

/// Down not faster than the program itself last went straight down.
double plunge_feed(const ModalState& state, const Watcher& watcher) {
    constexpr double slow_mm = 100.0; // per minute, where the program's feeds say nothing about it
    const bool by_the_minute = state.feed_mode == gcode::FeedMode::per_minute;
    const bool told = by_the_minute && state.feed_rate > 0.0;
    const double feed = told ? state.feed_rate : slow_mm / mm_of(state.unit);
    return std::min(feed, watcher.plunge().value_or(feed));
}

/// What the way down has changed: motion, distance and feed as they were.
void restore_modes(const ModalState& state, double plunge, std::vector<std::string>& lines) {
    const bool by_the_minute = state.feed_mode == gcode::FeedMode::per_minute;
    std::string line = state.motion == 0 ? "G0" : "G1";
    line += state.distance == gcode::DistanceMode::incremental ? " G91" : "";
    if (by_the_minute && state.feed_rate > plunge) {
        line += " " + drivers::number_word('F', state.feed_rate);
    }
    lines.push_back(line);
    if (!by_the_minute) { // on its own line: with G93 each move names its feed
        lines.emplace_back(state.feed_mode == gcode::FeedMode::inverse_time ? "G93" : "G95");
    }
}

/// In few lines, for it stands above the first that is left: words of one line take effect in the order of
/// RS-274, tool, spindle and coolant before the motion.
std::vector<std::string> approach(const ModalState& state,
                                  const Watcher& watcher,
                                  const RunFromSettings& settings,
                                  std::span<const std::string_view> lines_before,
                                  double clearance) {
    using gcode::SpindleTurning;
    std::vector<std::string> lines;
    ModalState by_the_minute = state;
    by_the_minute.feed_mode = gcode::FeedMode::per_minute;
    lines.push_back(modes_line(by_the_minute, settings.dialect) +
                    tool_words(state, watcher, settings.dialect));
    lines.push_back("G0 " + drivers::number_word('Z', clearance));
    lines.push_back(across(state, lines_before) + (state.flood ? " M8" : ""));
    if (state.spindle != SpindleTurning::stopped) {
        lines.back() += fmt::format(" {} {}",
                                    state.spindle == SpindleTurning::clockwise ? "M3" : "M4",
                                    drivers::number_word('S', state.spindle_speed));
        lines.push_back("G4 " + drivers::number_word('P', settings.spindle_time));
    }
    const double plunge = plunge_feed(state, watcher);
    lines.push_back("G1 " + drivers::number_word('Z', state.position[z_axis]) + " " +
                    drivers::number_word('F', plunge) + (state.mist ? " M7" : ""));
    restore_modes(state, plunge, lines);
    return lines;
}

/// The approach stands above the line, each of its own in the place of one that is left out.
void check_room(const std::vector<std::string>& before, const std::filesystem::path& file, int line) {
    if (line <= std::ssize(before)) {
        refuse_start(file,
                     line,
                     fmt::format("the approach to this line needs {} above it, but there are only {}",
                                 counted(before.size(), "line"),
                                 line - 1),
                     "run the program from the beginning");
    }
}

} // namespace

RunFrom run_from_line(std::string_view text,
                      const std::filesystem::path& file,
                      int line,
                      const RunFromSettings& settings) {
    const std::vector<std::string_view> lines = lines_of(text);
    if (line < 1 || line > std::ssize(lines)) {
        refuse_start(file, line, fmt::format("the program has only {}", counted(lines.size(), "line")));
    }
    check_flow(lines, file);
    Watcher watcher;
    const ModalState state = state_before(text, file, line, settings.dialect, watcher);
    check_state(state, lines[static_cast<std::size_t>(line) - 1], file, line);
    const double z = state.position[z_axis];
    const std::optional<double> clearance =
        settings.clearance ? std::optional(*settings.clearance / mm_of(state.unit)) : watcher.highest();
    if (!clearance || !(*clearance >= z)) {
        refuse_start(
            file,
            line,
            clearance
                ? fmt::format("the clearance Z{:.3f} is below Z{:.3f}, the start of this line", *clearance, z)
                : "the earlier lines give no Z at which the tool can travel safely",
            "specify a clearance");
    }
    const std::vector<std::string> before = approach(
        state, watcher, settings, std::span(lines).first(static_cast<std::size_t>(line) - 1), *clearance);
    check_room(before, file, line);
    RunFrom result{.text = {}, .line = line, .tool = state.selected_tool};
    for (const std::string& one : before) {
        result.text += one + "\n";
    }
    result.text.append(static_cast<std::size_t>(line) - 1 - before.size(), '\n');
    for (std::size_t n = static_cast<std::size_t>(line) - 1; n < lines.size(); ++n) {
        result.text += std::string(lines[n]) + "\n";
    }
    return result;
}

namespace {

/// The lines of `approach` above `line`, and from there on those of `whole`, with its tool changes.
std::string with_lines_of(std::string_view whole, std::string_view approach, int line) {
    const auto start_of = [line](std::string_view text) {
        std::size_t at = 0;
        for (int n = 1; n < line && at < text.size(); ++n) {
            at = std::min(text.find('\n', at), text.size() - 1) + 1;
        }
        return at;
    };
    return std::string(approach.substr(0, start_of(approach))) + std::string(whole.substr(start_of(whole)));
}

} // namespace

Job job_from_line(const Job& job, int line, const RunFromSettings& settings) {
    expects(job.listing != nullptr, "a job has a listing");
    if (job.program != nullptr) {
        return internal::program_from_line(job, line, settings);
    }
    const RunFrom rest = run_from_line(controller_text(job), job.project, line, settings);
    Job result = text_job(with_lines_of(job.listing->text, rest.text, line), job.project);
    result.tool_change = job.tool_change;
    if (const std::vector<ToolCall> calls = tool_calls(job.listing->text);
        job.tool_change && !calls.empty()) {
        result.tool_at_start = 0;
        for (const ToolCall& call : calls) { // a T alone only selects
            result.tool_at_start = call.line < line ? call.tool : *result.tool_at_start;
        }
    }
    result.name = job.name;
    result.started_at = job.started_at;
    result.from_line = line;
    result.hash = program_hash(job.listing->text);
    return result;
}

} // namespace millwright::jobs
