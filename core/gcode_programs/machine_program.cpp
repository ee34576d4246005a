#include "core/gcode_programs/machine_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/canon_frame.h"
#include "core/gcode/program_text.h"
#include "core/gcode_programs/internal/unsupported_features.h"
#include "core/gcode_programs/placement.h"
#include "core/gcode_programs/programmed_feed.h"
#include "core/kinematics/travel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace millwright::gcode {

namespace {

/// What the end of a program does automatically.
bool switches_off(const program::Block& block) {
    return block.kind == program::BlockKind::spindle_off || block.kind == program::BlockKind::coolant_off;
}

} // namespace

class MachineProgramBuilder::Parts {
public:
    Parts(const kinematics::MachineModel& machine,
          std::filesystem::path file,
          const MachineProgramSettings& settings)
        : machine_(machine), file_(std::move(file)), settings_(settings), losses_(file_),
          placement_(machine, file_, settings.start.has_value()) {
        expects(settings.chord_tolerance > 0.0, "a chord tolerance is positive");
        expects(!settings.chord_length || *settings.chord_length > 0.0, "a chord has a length");
        program::Program& program = result_.program;
        program.machine = machine.name();
        expects(!settings.start ||
                    (settings.start->size() == machine.axis_count() && settings.start->allFinite()),
                "a program starts at a position of its machine");
        program.start = settings.start.value_or(kinematics::AxisPositions::Zero(machine.axis_count()));
        for (int n = 0; n < machine.axis_count(); ++n) {
            const kinematics::MachineAxis& axis = machine.axis(n);
            program.axes.push_back({axis.letter, axis.kind});
            program.start[n] = settings.start ? program.start[n] : std::clamp(0.0, axis.min, axis.max);
            at_[index_of(axis.letter)] = in_program_units(axis, program.start[n]);
        }
    }

    void move(const Move& move, const SourceLine& now) {
        text_ = now.place == move.source ? now.text : std::string_view();
        losses_.move(move, text_);
        placement_.move(move, at_, frame_.to_machine(move.target), text_);
        const AxisValues start = frame_.from_machine(at_);
        switch (move.kind) {
        case MoveKind::traverse:
            return go(program::BlockKind::rapid, move.target, move.source);
        case MoveKind::feed:
        case MoveKind::probe:
            return go(program::BlockKind::feed, move.target, move.source);
        case MoveKind::arc:
            return arc(start, move);
        case MoveKind::rigid_tap:
            go(program::BlockKind::feed, move.target, move.source);
            return go(program::BlockKind::feed, start, move.source);
        }
    }

    void arc(const AxisValues& start, const Move& move) {
        const auto cut = [&](const AxisValues& end) { go(program::BlockKind::feed, end, move.source); };
        const double length = settings_.chord_length.value_or(0.0) / frame_.unit();
        const double count = settings_.chord_length ? chord_count_of_length(start, move, length)
                                                    : chord_count(start, move, tolerance());
        if (!(count <= most_chords)) {
            throw Error(Diagnostic{.place = {.file = file_, .line = move.source.line},
                                   .message = "this arc would need more than ten million chords",
                                   .hint = "use longer chords or a larger tolerance"});
        }
        if (settings_.chord_length) {
            arc_chords_of_length(start, move, length, cut);
        } else {
            arc_chords(start, move, tolerance(), cut);
        }
    }

    void curve(const Curve& curve, const SourceLine& now) {
        text_ = now.place == curve.source ? now.text : std::string_view();
        placement_.curve(curve.source, text_);
        const AxisValues start = frame_.from_machine(at_);
        curve_chords(start, curve, tolerance(), [&](const AxisValues& end) {
            go(program::BlockKind::feed, end, curve.source);
        });
    }

    void command(const Command& command, const SourceLine& now) {
        const std::string_view line = now.place == command.source ? now.text : std::string_view();
        frame_.command(command);
        feed_.command(command, frame_.unit());
        losses_.command(command, line);
        placement_.command(command, line);
        switch (command.kind) {
        case CommandKind::set_motion_control_mode:
            set_path_mode(command);
            break;
        case CommandKind::comment:
            if (command.text.find("interpreter: ") != 0) {
                comment_ = {command.source, std::string(command.text)};
            }
            break;
        case CommandKind::dwell:
            add(program::BlockKind::dwell, command.source).duration = command.value;
            break;
        case CommandKind::select_tool:
            selected_tool_ = command.index;
            break;
        case CommandKind::change_tool:
            pause(program::PauseKind::tool_change,
                  selected_tool_ > 0 ? fmt::format("change to tool {}", selected_tool_)
                                     : "remove the tool from the spindle",
                  command.source);
            break;
        case CommandKind::pallet_shuttle:
            pallet_moves_ = true;
            break;
        case CommandKind::program_stop:
            if (std::exchange(pallet_moves_, false)) {
                pause(program::PauseKind::pallet_change, "pallet change", command.source);
            } else {
                pause(program::PauseKind::program_stop, text_of_stop(command.source), command.source);
            }
            break;
        case CommandKind::optional_program_stop:
            pause(program::PauseKind::optional_stop, "optional stop", command.source);
            break;
        case CommandKind::program_end:
        case CommandKind::finish:
            end(command.source);
            break;
        default:
            turn_or_cool(command);
            break;
        }
    }

    [[nodiscard]] int block_count() const { return static_cast<int>(taken_) + result_.program.block_count(); }
    [[nodiscard]] MachineProgram take() {
        result_.lost = losses_.take_lost();
        result_.simplified = losses_.take_simplified();
        result_.unplaced = placement_.take_unplaced();
        result_.start_notice = placement_.start_notice();
        return std::move(result_);
    }

    /// All but the last, and what the end of the program would switch off anew in its line.
    void take_blocks(std::vector<program::Block>& out) {
        auto& blocks = result_.program.blocks;
        if (blocks.size() < 2) {
            return;
        }
        auto kept = blocks.end() - 1;
        while (kept != blocks.begin() && switches_off(*kept) && switches_off(*(kept - 1)) &&
               (kept - 1)->source_line == kept->source_line) {
            --kept;
        }
        if (kept == blocks.begin()) {
            return;
        }
        last_taken_ = (kept - 1)->target;
        taken_ += static_cast<std::size_t>(kept - blocks.begin());
        out.insert(out.end(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(kept));
        blocks.erase(blocks.begin(), kept);
    }

private:
    const kinematics::MachineModel& machine_;
    std::filesystem::path file_;
    MachineProgramSettings settings_;
    MachineProgram result_;
    internal::UnsupportedFeatures losses_;
    Placement placement_;
    std::size_t taken_ = 0; ///< blocks that are not in it any more
    kinematics::AxisPositions last_taken_;
    CanonFrame frame_;
    ProgrammedFeed feed_;
    std::optional<program::PathControl> path_; ///< none: not said yet
    std::optional<program::PathControl> path_before_cycle_;
    double rpm_ = 0.0;
    double turning_ = 0.0; ///< -1: counter-clockwise, 0: stands
    int selected_tool_ = 0;
    std::pair<SourcePlace, std::string> comment_; ///< the last one, and its line
    bool pallet_moves_ = false;                   ///< and then the program stops
    AxisValues at_;                               ///< on the machine, mm and degrees
    std::string_view text_;         ///< the line of the move at hand; empty where another line brought it
    std::set<char> missing_;        ///< axes that were complained about
    std::size_t first_missing_ = 0; ///< of the faults, the one of the first of them
    program::AxisSet beyond_;       ///< the same for their travel
    bool no_feed_said_ = false;

    /// Spindle and coolant.
    void turn_or_cool(const Command& command) {
        switch (command.kind) {
        case CommandKind::set_spindle_speed:
            set_speed(command);
            break;
        case CommandKind::start_spindle_clockwise:
            turn_spindle(1.0, command.source);
            break;
        case CommandKind::start_spindle_counterclockwise:
            turn_spindle(-1.0, command.source);
            break;
        case CommandKind::stop_spindle_turning:
            turning_ = 0.0;
            add(program::BlockKind::spindle_off, command.source);
            break;
        case CommandKind::mist_on:
        case CommandKind::flood_on:
            add(program::BlockKind::coolant_on, command.source);
            break;
        case CommandKind::mist_off:
        case CommandKind::flood_off:
            switch_coolant_off(command.source);
            break;
        default:
            break;
        }
    }

    void set_speed(const Command& command) {
        const bool changes = !exactly_equal(rpm_, command.value);
        rpm_ = command.value;
        result_.first_rpm = result_.first_rpm > 0.0 ? result_.first_rpm : std::abs(rpm_);
        if (changes && settings_.keeps_speed_changes && std::abs(turning_) > 0.0) {
            turn_spindle(turning_, command.source);
        }
    }

    /// The S of a line comes before its M3 or M4: both are one block.
    void turn_spindle(double turning, SourcePlace source) {
        turning_ = turning;
        auto& blocks = result_.program.blocks;
        const bool said = settings_.keeps_speed_changes && !blocks.empty() && source.file == 0 &&
                          blocks.back().kind == program::BlockKind::spindle_on &&
                          blocks.back().source_line == source.line;
        program::Block& block = said ? blocks.back() : add(program::BlockKind::spindle_on, source);
        block.spindle_rpm = turning * rpm_;
    }

    static std::size_t index_of(char letter) {
        return static_cast<std::size_t>(std::ranges::find(axis_letters, letter) - axis_letters.begin());
    }
    static double in_program_units(const kinematics::MachineAxis& axis, double position) {
        return axis.kind == kinematics::AxisKind::rotary ? to_degrees(position) : position;
    }

    /// In the unit that is in force.
    [[nodiscard]] double tolerance() const { return settings_.chord_tolerance / frame_.unit(); }

    program::Block& add(program::BlockKind kind, SourcePlace source) {
        program::Program& program = result_.program;
        if (taken_ + program.blocks.size() >= settings_.most_blocks) {
            throw Error(Diagnostic{
                .place = {.file = file_, .line = source.line},
                .message = fmt::format("the program has more than {} moves", settings_.most_blocks),
                .hint = "split the program"});
        }
        kinematics::AxisPositions here = !program.blocks.empty() ? program.blocks.back().target
                                         : taken_ > 0            ? last_taken_
                                                                 : program.start;
        program::Block& block = program.blocks.emplace_back();
        block.kind = kind;
        block.target = std::move(here);
        block.source_line = source.file == 0 ? source.line : 0;
        return block;
    }

    /// With the comment in its line or in the one above, which says what a person is to do.
    [[nodiscard]] std::string text_of_stop(SourcePlace source) const {
        constexpr std::string_view stop = "program stop";
        const auto& [place, text] = comment_;
        const bool is_about_it =
            place.file == source.file && (place.line == source.line || place.line + 1 == source.line);
        if (!is_about_it || text.empty()) {
            return std::string(stop);
        }
        return text.starts_with(stop) ? text : fmt::format("{}, {}", stop, text);
    }

    /// After a cycle nothing is said that was not said before.
    void set_path_mode(const Command& command) {
        const auto origin = static_cast<ModeOrigin>(command.mode);
        if (origin == ModeOrigin::cycle_end) {
            path_ = path_before_cycle_;
            return;
        }
        path_before_cycle_ = path_;
        path_ = {static_cast<program::PathMode>(command.index),
                 command.value * frame_.unit(),
                 origin == ModeOrigin::cycle};
    }

    void pause(program::PauseKind kind, std::string text, SourcePlace source) {
        program::Block& block = add(program::BlockKind::pause, source);
        block.pause = kind;
        block.text = std::move(text);
    }

    /// Once per line: M9 ends mist and flood.
    void switch_coolant_off(SourcePlace source) {
        const auto& blocks = result_.program.blocks;
        const bool done = !blocks.empty() && blocks.back().kind == program::BlockKind::coolant_off &&
                          blocks.back().source_line == source.line;
        if (!done) {
            add(program::BlockKind::coolant_off, source);
        }
    }

    /// What the end switches off needs no blocks.
    void end(SourcePlace source) {
        auto& blocks = result_.program.blocks;
        const auto switched_off = [&](const program::Block& block) {
            return switches_off(block) && source.line > 0 && block.source_line == source.line;
        };
        while (!blocks.empty() && switched_off(blocks.back())) {
            blocks.pop_back();
        }
        add(program::BlockKind::end, source);
    }

    void fault(SourcePlace source, char letter, std::string message) {
        if (result_.faults.size() < settings_.most_faults) {
            result_.faults.push_back(internal::at_word(file_, source, text_, letter, std::move(message)));
        }
    }

    void look_at_travel(int n, double position, SourcePlace source) {
        if (beyond_.contains(n)) {
            return;
        }
        const kinematics::MachineAxis& axis = machine_.axis(n);
        if (std::string sentence = kinematics::beyond_travel(axis, position); !sentence.empty()) {
            beyond_.insert(n);
            result_.beyond_travel.push_back(
                internal::at_word(file_, source, text_, axis.letter, std::move(sentence)));
        }
    }

    /// Each at its first place. The first one names all, since it may be the only one that is shown.
    void miss(SourcePlace source, char letter) {
        if (missing_.size() == 1) {
            first_missing_ = result_.faults.size();
        }
        fault(source, letter, fmt::format("the machine '{}' has no axis {}", machine_.name(), letter));
        if (missing_.size() > 1 && first_missing_ < result_.faults.size()) {
            result_.faults[first_missing_].hint = fmt::format(
                "the program moves {}, which the machine does not have", fmt::join(missing_, ", "));
        }
    }

    /// True if the machine has every axis that goes somewhere.
    bool can_go(const AxisValues& target, SourcePlace source) {
        bool can = true;
        for (std::size_t n = 0; n < axis_count; ++n) {
            const char letter = axis_letters[n];
            if (std::abs(target[n] - at_[n]) > same_place && machine_.axis_index(letter) < 0) {
                can = false;
                if (missing_.insert(letter).second) {
                    miss(source, letter);
                }
            }
        }
        return can;
    }

    /// Axes with a word in the line, and those that move.
    [[nodiscard]] program::AxisSet named_by(const AxisValues& end) const {
        program::AxisSet named = placement_.named();
        for (int n = 0; n < machine_.axis_count(); ++n) {
            const std::size_t letter = index_of(machine_.axis(n).letter);
            if (std::abs(end[letter] - at_[letter]) > same_place) {
                named.insert(n);
            }
        }
        return named;
    }

    [[nodiscard]] bool has_linear(const program::AxisSet& axes) const {
        return std::ranges::any_of(machine_.linear_axes(), [&](int n) { return axes.contains(n); });
    }

    /// To `target` in the frame of the program.
    void go(program::BlockKind kind, const AxisValues& target, SourcePlace source) {
        AxisValues end = frame_.to_machine(target);
        if (!can_go(end, source)) {
            return;
        }
        const program::AxisSet named = named_by(end);
        for (int n = 0; n < machine_.axis_count(); ++n) { // to the last bit, or it may round to another digit
            const std::size_t letter = index_of(machine_.axis(n).letter);
            end[letter] = named.contains(n) ? end[letter] : at_[letter];
        }
        if (named == program::AxisSet()) { // G0 alone, as in the head of a program: no axis is to go anywhere
            return;
        }
        double duration = 0.0;
        if (kind == program::BlockKind::feed) {
            const std::optional<double> found = feed_.duration(at_, end);
            if (!found && !std::exchange(no_feed_said_, true)) {
                fault(source,
                      '\0',
                      "a feed move has no feed rate, or a feed per revolution while the spindle is stopped "
                      "or its speed follows the diameter");
            }
            if (!found) {
                return;
            }
            duration = *found;
        }
        program::Block& block = add(kind, source);
        block.named = named;
        block.duration = duration;
        block.path = path_;
        for (int n = 0; n < machine_.axis_count(); ++n) {
            const kinematics::MachineAxis& axis = machine_.axis(n);
            const double value = end[index_of(axis.letter)];
            block.target[n] = axis.kind == kinematics::AxisKind::rotary ? from_degrees(value) : value;
            look_at_travel(n, block.target[n], source);
        }
        const double way = linear_distance(at_, end);
        block.feed = duration > 0.0 ? way / duration : 0.0;
        if (kind == program::BlockKind::feed && placement_.starts_anywhere()) {
            block.programmed_speed = has_linear(named) ? feed_.speed() : feed_.angular_speed();
        }
        result_.length += way;
        at_ = end;
    }
};

std::vector<Diagnostic> MachineProgram::unknown_positions() const {
    std::vector<Diagnostic> found = unplaced;
    if (start_notice) {
        found.push_back(*start_notice);
    }
    return found;
}

program::Listing listing_of(std::string_view text, const program::Program& program) {
    program::Listing listing;
    listing.text = with_newlines(std::string(text));
    if (listing.text.empty() || listing.text.back() != '\n') {
        listing.text += '\n';
    }
    listing.line_starts.push_back(0);
    for (std::size_t n = 0; n < listing.text.size(); ++n) {
        if (listing.text[n] == '\n') {
            listing.line_starts.push_back(n + 1);
        }
    }
    for (const program::Block& block : program.blocks) {
        listing.line_of_block.push_back(std::max(block.source_line, 1));
    }
    return listing;
}

MachineProgramBuilder::MachineProgramBuilder(const kinematics::MachineModel& machine,
                                             std::filesystem::path file,
                                             const MachineProgramSettings& settings)
    : parts_(std::make_unique<Parts>(machine, std::move(file), settings)) {}

MachineProgramBuilder::~MachineProgramBuilder() = default;

void MachineProgramBuilder::move(const Move& move, const SourceLine& now) {
    parts_->move(move, now);
}

void MachineProgramBuilder::curve(const Curve& curve, const SourceLine& now) {
    parts_->curve(curve, now);
}

void MachineProgramBuilder::command(const Command& command, const SourceLine& now) {
    parts_->command(command, now);
}

int MachineProgramBuilder::block_count() const {
    return parts_->block_count();
}

void MachineProgramBuilder::take_blocks(std::vector<program::Block>& blocks) {
    parts_->take_blocks(blocks);
}

MachineProgram MachineProgramBuilder::take() {
    return parts_->take();
}

} // namespace millwright::gcode
