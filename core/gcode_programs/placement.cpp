#include "core/gcode_programs/placement.h"

#include "core/base/numbers.h"
#include "core/gcode/modal_state.h"
#include "core/gcode_programs/internal/unsupported_features.h"
#include "core/gcode_programs/programmed_feed.h"
#include "core/program/retract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace millwright::gcode {

namespace {

constexpr int g10_in_tenths = 100;
constexpr const char* place_by_rapid = "move the axis to a position in G90 first";
constexpr const char* place_the_work = "give the program zero in machine coordinates: --origin X,Y,Z (for "
                                       "plots --work-origin); gcode and plot also accept --parameters FILE";

std::string_view code_of_frame(MoveFrame frame) {
    switch (frame) {
    case MoveFrame::machine:
        return "G53";
    case MoveFrame::reference:
        return "G28";
    case MoveFrame::reference_2:
        return "G30";
    case MoveFrame::work:
        break;
    }
    return "a move";
}

std::string code_in_tenths(int tenths) {
    return tenths % 10 == 0 ? fmt::format("G{}", tenths / 10)
                            : fmt::format("G{}.{}", tenths / 10, tenths % 10);
}

} // namespace

std::string name_of_system(int system) {
    constexpr int whole = 6; // G54 to G59
    return system <= whole ? fmt::format("G{}", 53 + system) : fmt::format("G59.{}", system - whole);
}

Placement::Placement(const kinematics::MachineModel& machine, std::filesystem::path file, bool start_known)
    : machine_(machine), file_(std::move(file)), starts_(machine),
      known_(start_known ? program::AxisSet::all(machine.axis_count()) : program::AxisSet()),
      frame_used_(static_cast<std::size_t>(machine.axis_count())) {
    for (int n = 0; n < machine.axis_count(); ++n) {
        index_of_.push_back(
            static_cast<std::size_t>(std::ranges::find(axis_letters, letter_of(n)) - axis_letters.begin()));
    }
}

void Placement::refuse(Kind kind, SourcePlace source, std::string_view line, char letter, Diagnostic found) {
    if (refused_.insert(kind).second) {
        std::string hint = std::move(found.hint);
        Diagnostic placed = internal::at_word(file_, source, line, letter, std::move(found.message));
        placed.hint = std::move(hint);
        unplaced_.push_back(std::move(placed));
    }
}

void Placement::refuse_at(Kind kind, SourcePlace source, int column, Diagnostic found) {
    if (refused_.insert(kind).second) {
        found.place = {file_, source.line, column, -1};
        unplaced_.push_back(std::move(found));
    }
}

/// X and Y are turned together, on a machine that has both.
bool Placement::is_turned(int axis) const {
    const char letter = letter_of(axis);
    return (letter == 'X' || letter == 'Y') && machine_.axis_index('X') >= 0 && machine_.axis_index('Y') >= 0;
}

Placement::Frame Placement::frame_of(int axis) const {
    constexpr AxisBits in_plane = 0b11;
    const std::size_t index = index_of_[static_cast<std::size_t>(axis)];
    const bool of_both = is_turned(axis) && rotation_known_ && !exactly_equal(rotation_deg_, 0.0);
    const bool system =
        of_both ? (system_known_ & in_plane) == in_plane : ((system_known_ >> index) & 1) != 0;
    return {system ? 0 : system_, is_turned(axis) ? turned_ : 0, ((g92_known_ >> index) & 1) == 0};
}

/// What of `frame` is not known and otherwise in `other`.
std::string Placement::name_of_unknown(const Frame& frame, const Frame& other) const {
    if (frame.system != other.system) {
        return "the offset of " + name_of_system(frame.system > 0 ? frame.system : other.system);
    }
    if (frame.turned != other.turned) {
        const int place = frame.turned > 0 ? frame.turned : other.turned;
        return "the rotation of " +
               name_of_system(turned_places_[static_cast<std::size_t>(place) - 1].system);
    }
    return "the offset of G92";
}

std::string Placement::remedy_for(const Frame& frame, const Frame& other) {
    if (frame.system != other.system) {
        return place_the_work;
    }
    return (frame.turned != other.turned ? "set the rotation with R of G10 L2 before the first move, or "
                                         : "clear it with G92.1 before the first move, or ") +
           std::string(place_the_work);
}

/// Touching off moves the system along its own axes, however it is turned: positions before and after it are
/// still known to each other.
void Placement::find_turned_place() {
    if (rotation_known_) {
        turned_ = 0;
        return;
    }
    const TurnedPlace now{system_, offset_ + tool_};
    if (std::exchange(touched_off_, false) && turned_ > 0 &&
        turned_places_[static_cast<std::size_t>(turned_) - 1].system == system_) {
        turned_places_[static_cast<std::size_t>(turned_) - 1] = now;
        return;
    }
    const auto found = std::ranges::find_if(turned_places_, [&](const TurnedPlace& place) {
        return place.system == now.system && (place.offset - now.offset).norm() <= same_place;
    });
    turned_ = static_cast<int>(found - turned_places_.begin()) + 1;
    if (found == turned_places_.end()) {
        turned_places_.push_back(now);
    }
}

void Placement::take_rotation(const Command& command) {
    rotation_known_ = command.index == 1;
    rotation_deg_ = command.value;
    find_turned_place();
}

void Placement::command(const Command& command, std::string_view line) {
    const auto in_plane = [&] { return Vec2(command.axes[Axis::x] * unit_, command.axes[Axis::y] * unit_); };
    touched_off_ = touched_off_ && (command.kind == CommandKind::set_g5x_offset ||
                                    command.kind == CommandKind::set_xy_rotation);
    switch (command.kind) {
    case CommandKind::use_length_units:
        unit_ = command.index == static_cast<int>(LengthUnit::inch) ? mm_per_inch : 1.0;
        return;
    case CommandKind::set_g5x_offset:
        system_ = command.index;
        system_known_ = static_cast<AxisBits>(command.mode);
        offset_ = in_plane();
        return;
    case CommandKind::set_xy_rotation:
        return take_rotation(command);
    case CommandKind::use_tool_length_offset:
        tool_ = in_plane();
        starts_.use_tool(command.axes, unit_);
        return find_turned_place();
    case CommandKind::set_g92_offset:
        g92_known_ = static_cast<AxisBits>(command.mode);
        return;
    case CommandKind::measure_position:
        touched_off_ = command.index == g10_in_tenths;
        return measured(command, line);
    case CommandKind::read_unknown:
        return read_unknown(command);
    default:
        return;
    }
}

/// The position of an axis that the program has not named, or has named in another system, is not known.
void Placement::measured(const Command& command, std::string_view line) {
    const bool by_parameter = command.index == 0;
    const bool on_machine = command.value_2 > 0.0;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (((command.mode >> index_of_[static_cast<std::size_t>(n)]) & 1) == 0) {
            continue;
        }
        const auto& used = frame_used_[static_cast<std::size_t>(n)];
        const Frame frame = on_machine ? Frame() : frame_of(n);
        Diagnostic found;
        if (!known_.contains(n)) {
            found = {{},
                     fmt::format("{} uses the present position of {}, but the program has not set it yet",
                                 by_parameter ? "a parameter" : code_in_tenths(command.index),
                                 letter_of(n)),
                     place_by_rapid};
        } else if (used.value_or(frame) != frame) {
            found = {{},
                     fmt::format("{} uses the position of {} {}, but {} is unknown",
                                 by_parameter ? "a parameter" : code_in_tenths(command.index),
                                 letter_of(n),
                                 on_machine ? "in machine coordinates" : "in " + name_of_system(system_),
                                 name_of_unknown(*used, frame)),
                     remedy_for(*used, frame)};
        } else {
            continue;
        }
        if (by_parameter) {
            refuse_at(Kind::measured, command.source, static_cast<int>(command.value), std::move(found));
        } else {
            refuse(Kind::measured, command.source, line, 'G', std::move(found));
        }
    }
}

/// It reads as 0, and the line would make a position of that.
void Placement::read_unknown(const Command& command) {
    constexpr int first_of_tool = 5400;
    constexpr int first_of_g92 = 5210;
    constexpr int first_of_systems = 5221;
    constexpr int stride = 20;
    const int number = command.index;
    const bool of_tool = number >= first_of_tool;
    const bool of_system = number >= first_of_systems && !of_tool;
    const std::string what = of_tool ? "data of the tool in the spindle"
                             : of_system
                                 ? "an offset of " + name_of_system(1 + (number - first_of_systems) / stride)
                             : number >= first_of_g92 ? "an offset of G92"
                             : number >= 5180         ? "the stored position of G30"
                                                      : "the stored position of G28";
    refuse_at(Kind::stored,
              command.source,
              command.mode,
              {{},
               fmt::format("#{} is {}, but its value is unknown", number, what),
               of_tool     ? "load the tool with T and M6, and give the tool data with --tools FILE"
               : of_system ? place_the_work
                           : "give the stored values of the control with --parameters FILE"});
}

void Placement::curve(SourcePlace source, std::string_view line) {
    named_ = {};
    starts_anywhere_ = false;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        const bool in_plane = letter_of(n) == 'X' || letter_of(n) == 'Y';
        if (in_plane && !known_.contains(n)) {
            refuse(Kind::arc,
                   source,
                   line,
                   'G',
                   {{},
                    fmt::format("a curve starts before the program has set the position of {}", letter_of(n)),
                    place_by_rapid});
        }
        if (in_plane) {
            expect_one_frame(n, source, line);
        }
    }
    starts_.curve();
}

void Placement::move(const Move& move, const AxisValues& from, const AxisValues& to, std::string_view line) {
    std::vector<int> moving;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        const std::size_t index = index_of_[static_cast<std::size_t>(n)];
        if (std::abs(to[index] - from[index]) > same_place) {
            moving.push_back(n);
        }
    }
    expect_known_begin(move, moving, line);
    look_at_reference(move, from, to, line);
    take_words(move, line);
    if (!(named_ == program::AxisSet()) || !moving.empty()) {
        look_at_frame(move, moving, line);
        starts_.move(move, from, to, {known_, named_, moving, knows_height(move)});
    }
}

/// Whether it is known where the move ends along the retract axis, as to the work.
bool Placement::knows_height(const Move& move) const {
    return move.words.frame == MoveFrame::work ||
           (!machine_.linear_axes().empty() && frame_of(program::retract_axis(machine_).axis).is_machine());
}

/// An arc has its centre from where it begins, and the move onto a compensated path its direction; an axis
/// without a word of its own is moved by as much as its beginning is off.
void Placement::expect_known_begin(const Move& move, const std::vector<int>& moving, std::string_view line) {
    const std::string_view plane = move.plane == Plane::xy   ? "XY"
                                   : move.plane == Plane::xz ? "XZ"
                                   : move.plane == Plane::yz ? "YZ"
                                                             : "UVW";
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (known_.contains(n)) {
            continue;
        }
        const bool moves = std::ranges::find(moving, n) != moving.end();
        const char letter = letter_of(n);
        if (move.kind == MoveKind::arc && (moves || plane.find(letter) != std::string_view::npos)) {
            refuse(Kind::arc,
                   move.source,
                   line,
                   'G',
                   {{},
                    fmt::format("an arc starts before the program has set the position of {}", letter),
                    place_by_rapid});
        } else if (move.enters_compensation && plane.find(letter) != std::string_view::npos) {
            refuse(Kind::compensation,
                   move.source,
                   line,
                   letter,
                   {{},
                    fmt::format(
                        "cutter compensation (G41, G42) starts before the program has set the position of {}",
                        letter),
                    place_by_rapid});
        } else if (moves &&
                   (!move.words.names(index_of_[static_cast<std::size_t>(n)]) || move.words.incremental)) {
            refuse(Kind::increment,
                   move.source,
                   line,
                   letter,
                   {{},
                    fmt::format("{} moves from its present position, but the program has not set it yet",
                                letter),
                    place_by_rapid});
        }
    }
}

void Placement::take_words(const Move& move, std::string_view line) {
    named_ = {};
    starts_anywhere_ = false;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (!move.words.names(index_of_[static_cast<std::size_t>(n)])) {
            continue;
        }
        if (!known_.contains(n) && !move.words.incremental) {
            known_.insert(n);
            starts_anywhere_ = true;
            starts_.set(n, move.source.line);
        }
        if (known_.contains(n)) {
            named_.insert(n);
        }
    }
    if (starts_anywhere_ && move.words.inverse_time && move.kind == MoveKind::feed) {
        refuse(Kind::inverse_time,
               move.source,
               line,
               'F',
               {{},
                "an inverse time feed move (G93) starts at an unknown position, so it has no speed",
                "start with a rapid move that contains all axes"});
    }
}

/// All positions of an axis are written in one system: that of the work, or the machine's where it is known
/// how the two lie to each other.
void Placement::look_at_frame(const Move& move, const std::vector<int>& moving, std::string_view line) {
    const bool of_machine = move.words.frame != MoveFrame::work;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (!named_.contains(n) && std::ranges::find(moving, n) == moving.end()) {
            continue;
        }
        const Frame frame = frame_of(n);
        if (of_machine && !frame.is_machine()) {
            const bool of_one = frame.turned == 0 && system_known_ != 0;
            refuse(Kind::machine_position,
                   move.source,
                   line,
                   'G',
                   {{},
                    fmt::format("{} moves to a machine position, but {} is unknown{}",
                                code_of_frame(move.words.frame),
                                frame.system > 0 ? "the program zero in machine coordinates"
                                                 : name_of_unknown(frame, Frame()),
                                of_one ? fmt::format(" in {}", letter_of(n)) : ""),
                    remedy_for(frame, Frame())});
            continue;
        }
        expect_one_frame(n, move.source, line);
    }
}

void Placement::expect_one_frame(int axis, SourcePlace source, std::string_view line) {
    const Frame frame = frame_of(axis);
    std::optional<Frame>& used = frame_used_[static_cast<std::size_t>(axis)];
    const Frame before = used.value_or(frame);
    used = before;
    if (frame != before) {
        refuse(Kind::two_systems,
               source,
               line,
               'G',
               {{},
                fmt::format(
                    "{} moves in two coordinate systems, but {} is unknown: the positions cannot be related",
                    letter_of(axis),
                    name_of_unknown(frame, before)),
                remedy_for(frame, before)});
    }
}

/// A reference point that is not stored is taken for machine zero: no retract goes down to that.
void Placement::look_at_reference(const Move& move,
                                  const AxisValues& from,
                                  const AxisValues& to,
                                  std::string_view line) {
    const bool stored =
        move.words.frame != MoveFrame::reference && move.words.frame != MoveFrame::reference_2;
    if (stored || machine_.linear_axes().empty()) {
        return;
    }
    const program::RetractAxis retract = program::retract_axis(machine_);
    const std::size_t index = index_of_[static_cast<std::size_t>(retract.axis)];
    if (!frame_of(retract.axis).is_machine() || ((move.words.reference_set >> index) & 1) != 0) {
        return;
    }
    if (known_.contains(retract.axis) && retract.sense * (to[index] - from[index]) < -same_place) {
        refuse(Kind::lowers,
               move.source,
               line,
               'G',
               {{},
                fmt::format("{} would move {} from {:.3f} to {:.3f}, towards the part: its position was "
                            "never stored, so machine zero is assumed",
                            code_of_frame(move.words.frame),
                            letter_of(retract.axis),
                            from[index],
                            to[index]),
                "give the stored position with --parameters FILE"});
    }
}

std::optional<Diagnostic> Placement::start_notice() const {
    return starts_.notice(file_);
}

} // namespace millwright::gcode
