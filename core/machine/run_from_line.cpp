#include "core/machine/run_from_line.h"

#include "core/gcode/reader/interpreter.h"
#include "core/machine/internal/approach_room.h"
#include "core/machine/internal/bare_line.h"
#include "core/machine/internal/program_from_line.h"
#include "core/machine/modal_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::machine {

namespace {

using gcode::AxisValues;
using gcode::Command;
using gcode::CommandKind;
using gcode::Dialect;
using gcode::ModalState;
using gcode::Move;
using gcode::MoveKind;
using internal::has_code;

constexpr int z_axis = 2;

[[noreturn]] void
refuse(const std::filesystem::path& file, int line, std::string why, std::string hint = {}) {
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
        const std::string text = internal::bare_line(lines[n]);
        const int number = static_cast<int>(n) + 1;
        if (internal::is_flow(text)) {
            refuse(file, number, "a program with subroutines or loops cannot be begun in its middle");
        }
        if (text.find('#') != std::string::npos) {
            refuse(file, number, "a program with parameters cannot be begun in its middle");
        }
        if (text.find("G38.") != std::string::npos) {
            refuse(file, number, "a program that probes cannot be begun in its middle");
        }
    }
}

/// G53, G28 and G30 go to machine positions, of which a program does not know the work coordinates.
bool goes_by_the_machine(std::string_view bare_line) {
    return has_code(bare_line, "G53") || has_code(bare_line, "G28") || has_code(bare_line, "G30");
}

/// The axes whose work coordinates the lines tell.
class KnownAxes {
public:
    void take(std::string_view bare_line, bool incremental) {
        if (goes_by_the_machine(bare_line)) {
            known_.fill(false);
            left_ = true;
            return;
        }
        for (std::size_t n = 0; n < known_.size() && !incremental; ++n) {
            known_[n] = known_[n] || bare_line.find(gcode::axis_letters[n]) != std::string_view::npos;
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
    std::array<bool, 3> known_{}; ///< X Y Z: where the machine stood at the start, nobody wrote down
    bool left_ = false;
};

/// Watches the lines that are left out.
class Watcher final : public gcode::CanonSink {
public:
    void move(const Move& move, const gcode::SourceLine& now) override {
        if (move.kind == MoveKind::traverse && !goes_by_the_machine(internal::bare_line(now.text))) {
            const double z = move.target[gcode::Axis::z];
            highest_ = std::max(highest_.value_or(z), z);
        }
    }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const Command& command, const gcode::SourceLine&) override {
        const bool frame = command.kind == CommandKind::use_length_units ||
                           command.kind == CommandKind::set_g5x_offset ||
                           command.kind == CommandKind::set_g92_offset ||
                           command.kind == CommandKind::use_tool_length_offset;
        if (frame) {
            highest_.reset(); // Z means something else from here on
        }
        if (command.kind == CommandKind::change_tool) {
            changed_ = true;
        }
    }

    [[nodiscard]] std::optional<double> highest() const { return highest_; }
    [[nodiscard]] bool changed_tool() const { return changed_; }

private:
    std::optional<double> highest_; ///< Z of a rapid, as programmed
    bool changed_ = false;
};

/// What is in force before `line` is executed.
ModalState state_before(
    std::string_view text, const std::filesystem::path& file, int line, Dialect dialect, Watcher& watcher) {
    gcode::ReaderSettings settings;
    settings.dialect = dialect;
    settings.any_tool = true;
    gcode::Interpreter reader(text, file, std::move(settings), watcher);
    const std::vector<std::string_view> lines = lines_of(text);
    KnownAxes known;
    for (int next = 1; next < line; ++next) {
        const bool more = reader.step();
        const std::string words = internal::bare_line(lines[static_cast<std::size_t>(next) - 1]);
        known.take(words, reader.state().incremental);
        if (has_code(words, "G10") || has_code(words, "G92") || has_code(words, "G52")) {
            refuse(
                file, next, "the lines before change offsets (G10, G52, G92)", "run it from its beginning");
        }
        if (!reader.errors().empty()) {
            throw Error(reader.errors().front());
        }
        if (!more) {
            refuse(file, line, fmt::format("the program ends at line {}", reader.place().line));
        }
    }
    if (const char axis = known.unknown(); axis != '\0') {
        refuse(file,
               line,
               known.left()
                   ? fmt::format(
                         "the lines before go to a machine position (G53, G28, G30), and none tells {} since",
                         axis)
                   : fmt::format(
                         "none of the lines before tells where {} is (by G90), so nobody knows where the "
                         "machine would be here",
                         axis),
               "begin a few lines later, or run it from its beginning");
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
        refuse(file, line, "cutter compensation is on here (G41, G42)", "begin where it is off");
    }
    if (state.motion >= first_cycle && state.motion <= last_cycle && state.motion != no_motion) {
        refuse(file, line, "a canned cycle is in force here", "begin at its first line, or after G80");
    }
    if (state.constant_surface_speed) {
        refuse(file, line, "constant surface speed is in force here (G96)");
    }
    const std::string text = internal::bare_line(first_line);
    const bool straight = state.motion == 0 || state.motion == 10 || state.motion == no_motion;
    const bool names_motion = text.find('G') != std::string::npos;
    if (!straight && !names_motion) {
        refuse(
            file, line, "the line goes on with an arc or a spline", "begin at a line that names its motion");
    }
}

/// In one line: all of these are of different modal groups.
std::string modes_line(const ModalState& state, Dialect dialect) {
    ModalState absolute = state;
    absolute.incremental = false;
    std::string text = modal_lines(absolute, dialect);
    std::string line;
    for (const char c : text) {
        line += c == '\n' ? ' ' : c;
    }
    line.pop_back();
    return line;
}

std::vector<std::string> approach(const ModalState& state,
                                  const Watcher& watcher,
                                  const RunFromSettings& settings,
                                  double clearance,
                                  double feed) {
    const bool linuxcnc = settings.dialect == Dialect::linuxcnc;
    std::vector<std::string> lines;
    ModalState by_the_minute = state;
    by_the_minute.feed_mode = gcode::FeedMode::per_minute;
    lines.push_back(modes_line(by_the_minute, settings.dialect));
    if (state.selected_tool > 0) {
        lines.push_back(
            fmt::format("T{}{}", state.selected_tool, linuxcnc && watcher.changed_tool() ? " M6" : ""));
    }
    lines.push_back("G0 " + number_word('Z', clearance));
    std::string others = "G0";
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const bool named = n < 3 || linuxcnc;
        if (n != z_axis && named && (n < 3 || std::abs(state.position[n]) > 0.0)) {
            others += " " + number_word(gcode::axis_letters[n], state.position[n]);
        }
    }
    lines.push_back(others);
    using gcode::SpindleTurning;
    if (state.spindle != SpindleTurning::stopped) {
        lines.push_back(fmt::format("{} {}",
                                    state.spindle == SpindleTurning::clockwise ? "M3" : "M4",
                                    number_word('S', state.spindle_speed)));
        lines.push_back("G4 " + number_word('P', settings.spindle_time));
    }
    if (state.mist) {
        lines.push_back("M7");
    }
    if (state.flood) {
        lines.push_back("M8");
    }
    lines.push_back("G1 " + number_word('Z', state.position[z_axis]) + " " + number_word('F', feed));
    lines.push_back(fmt::format("{}{}", state.motion == 0 ? "G0" : "G1", state.incremental ? " G91" : ""));
    if (state.feed_mode != gcode::FeedMode::per_minute) { // by itself: with G93 each move names its feed
        lines.emplace_back(state.feed_mode == gcode::FeedMode::inverse_time ? "G93" : "G95");
    }
    return lines;
}

} // namespace

RunFrom run_from_line(std::string_view text,
                      const std::filesystem::path& file,
                      int line,
                      const RunFromSettings& settings) {
    const std::vector<std::string_view> lines = lines_of(text);
    if (line < 1 || line > std::ssize(lines)) {
        refuse(file, line, fmt::format("the program has {} lines", lines.size()));
    }
    internal::check_room_above(line, line, file);
    check_flow(lines, file);
    Watcher watcher;
    const ModalState state = state_before(text, file, line, settings.dialect, watcher);
    check_state(state, lines[static_cast<std::size_t>(line) - 1], file, line);
    const double z = state.position[z_axis];
    const std::optional<double> clearance = settings.clearance ? settings.clearance : watcher.highest();
    if (!clearance || !(*clearance >= z)) {
        refuse(
            file,
            line,
            clearance
                ? fmt::format("the clearance Z{:.3f} is below Z{:.3f}, where this line begins", *clearance, z)
                : "the lines before do not tell at which Z the tool can go anywhere",
            "name the clearance");
    }
    const bool by_the_minute = state.feed_mode == gcode::FeedMode::per_minute;
    const double feed = state.feed_rate;
    constexpr double slow_mm = 100.0; // a minute, where the program's feeds say nothing about it
    const double plunge = by_the_minute && feed > 0.0           ? feed
                          : state.unit == gcode::LengthUnit::mm ? slow_mm
                                                                : slow_mm / gcode::mm_per_inch;
    const std::vector<std::string> before = approach(state, watcher, settings, *clearance, plunge);
    expects(std::ssize(before) <= approach_lines, "an approach has its room above the line");
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

Job job_from_line(const Job& job, int line, const RunFromSettings& settings) {
    expects(job.listing != nullptr, "a job has a listing");
    if (job.program != nullptr) {
        return internal::program_from_line(job, line, settings);
    }
    const RunFrom rest = run_from_line(job.listing->text, job.project, line, settings);
    Job result = text_job(rest.text, job.project);
    result.name = job.name;
    result.started_at = job.started_at;
    result.from_line = line;
    result.hash = program_hash(job.listing->text);
    return result;
}

} // namespace millwright::machine
