#include "core/gcode/reader/machine_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/reader/canon_frame.h"
#include "core/gcode/reader/internal/chords.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr double seconds_a_minute = 60.0;
constexpr double same_place = 1e-9; // mm or degrees: rounding of offsets

double distance(const AxisValues& a, const AxisValues& b, std::initializer_list<Axis> axes) {
    double sum = 0.0;
    for (const Axis axis : axes) {
        sum += square(b[axis] - a[axis]);
    }
    return std::sqrt(sum);
}

double linear_distance(const AxisValues& a, const AxisValues& b) {
    return distance(a, b, {Axis::x, Axis::y, Axis::z});
}

/// The feeds in force, as programmed.
struct Feed {
    double rate = 0.0;         ///< mm a minute
    double angular_rate = 0.0; ///< degrees a minute
    double a_revolution = 0.0; ///< mm; > 0: the spindle leads
    double rpm = 0.0;

    /// s; nothing without a feed.
    [[nodiscard]] std::optional<double> duration(const AxisValues& from, const AxisValues& to) const {
        double way = linear_distance(from, to);
        if (way <= same_place) {
            way = distance(from, to, {Axis::u, Axis::v, Axis::w});
        }
        const bool is_angular = way <= same_place;
        if (is_angular) {
            way = distance(from, to, {Axis::a, Axis::b, Axis::c});
        }
        if (way <= same_place) {
            return 0.0;
        }
        const double led = a_revolution > 0.0 ? a_revolution * rpm : rate;
        const double speed = is_angular ? angular_rate : led;
        return speed > 0.0 ? std::optional(way / speed * seconds_a_minute) : std::nullopt;
    }
};

} // namespace

class MachineProgramBuilder::Parts {
public:
    Parts(const kinematics::MachineModel& machine,
          std::filesystem::path file,
          const MachineProgramSettings& settings)
        : machine_(machine), file_(std::move(file)), settings_(settings) {
        expects(settings.chord_tolerance > 0.0, "a chord tolerance is positive");
        Program& program = result_.program;
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

    void move(const Move& move) {
        const AxisValues start = frame_.from_machine(at_);
        switch (move.kind) {
        case MoveKind::traverse:
            return go(BlockKind::rapid, move.target, move.source);
        case MoveKind::feed:
        case MoveKind::probe:
            return go(BlockKind::feed, move.target, move.source);
        case MoveKind::arc:
            return internal::arc_chords(start, move, tolerance(), [&](const AxisValues& end) {
                go(BlockKind::feed, end, move.source);
            });
        case MoveKind::rigid_tap:
            go(BlockKind::feed, move.target, move.source);
            return go(BlockKind::feed, start, move.source);
        }
    }

    void curve(const Curve& curve) {
        const AxisValues start = frame_.from_machine(at_);
        internal::curve_chords(start, curve, tolerance(), [&](const AxisValues& end) {
            go(BlockKind::feed, end, curve.source);
        });
    }

    void command(const Command& command) {
        frame_.command(command);
        set_feed(command);
        switch (command.kind) {
        case CommandKind::set_motion_control_mode:
            path_ = {static_cast<PathMode>(command.index), command.value * frame_.unit()};
            break;
        case CommandKind::dwell:
            add(BlockKind::dwell, command.source).duration = command.value;
            break;
        case CommandKind::set_spindle_speed:
            feed_.rpm = command.value;
            break;
        case CommandKind::start_spindle_clockwise:
            add(BlockKind::spindle_on, command.source).spindle_rpm = feed_.rpm;
            break;
        case CommandKind::start_spindle_counterclockwise:
            add(BlockKind::spindle_on, command.source).spindle_rpm = -feed_.rpm;
            break;
        case CommandKind::stop_spindle_turning:
            add(BlockKind::spindle_off, command.source);
            break;
        case CommandKind::mist_on:
        case CommandKind::flood_on:
            add(BlockKind::coolant_on, command.source);
            break;
        case CommandKind::mist_off:
        case CommandKind::flood_off:
            add(BlockKind::coolant_off, command.source);
            break;
        case CommandKind::change_tool:
        case CommandKind::change_tool_number:
            add(BlockKind::pause, command.source).text = "tool change";
            break;
        case CommandKind::program_stop:
            add(BlockKind::pause, command.source).text = "program stop";
            break;
        case CommandKind::optional_program_stop:
            add(BlockKind::pause, command.source).text = "optional stop";
            break;
        case CommandKind::program_end:
        case CommandKind::finish:
            add(BlockKind::end, command.source);
            break;
        default:
            break;
        }
    }

    [[nodiscard]] MachineProgram take() { return std::move(result_); }

private:
    const kinematics::MachineModel& machine_;
    std::filesystem::path file_;
    MachineProgramSettings settings_;
    MachineProgram result_;
    CanonFrame frame_;
    Feed feed_;
    std::optional<PathControl> path_; ///< none: not said yet
    AxisValues at_;                   ///< on the machine, mm and degrees
    std::set<char> missing_;          ///< axes that were complained about
    bool no_feed_said_ = false;

    static std::size_t index_of(char letter) {
        return static_cast<std::size_t>(std::ranges::find(axis_letters, letter) - axis_letters.begin());
    }
    static double in_program_units(const kinematics::MachineAxis& axis, double position) {
        return axis.kind == kinematics::AxisKind::rotary ? to_degrees(position) : position;
    }

    /// In the unit that is in force.
    [[nodiscard]] double tolerance() const { return settings_.chord_tolerance / frame_.unit(); }

    void set_feed(const Command& command) {
        if (command.kind == CommandKind::set_feed_rate) {
            feed_.rate = command.value * frame_.unit();
            feed_.angular_rate = command.value;
        } else if (command.kind == CommandKind::start_speed_feed_synch) {
            feed_.a_revolution = command.value * frame_.unit();
        } else if (command.kind == CommandKind::stop_speed_feed_synch) {
            feed_.a_revolution = 0.0;
        }
    }

    Block& add(BlockKind kind, SourcePlace source) {
        Program& program = result_.program;
        kinematics::AxisPositions here =
            program.blocks.empty() ? program.start : program.blocks.back().target;
        Block& block = program.blocks.emplace_back();
        block.kind = kind;
        block.target = std::move(here);
        block.source_line = source.file == 0 ? source.line : 0;
        return block;
    }

    void fault(SourcePlace source, std::string message) {
        if (result_.faults.size() < settings_.most_faults) {
            result_.faults.push_back({{file_, source.line, 0, -1}, std::move(message), {}});
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
                    fault(source, fmt::format("the machine '{}' has no axis {}", machine_.name(), letter));
                }
            }
        }
        return can;
    }

    /// To `target` in the frame of the program.
    void go(BlockKind kind, const AxisValues& target, SourcePlace source) {
        const AxisValues end = frame_.to_machine(target);
        if (!can_go(end, source)) {
            return;
        }
        double duration = 0.0;
        if (kind == BlockKind::feed) {
            const std::optional<double> found = feed_.duration(at_, end);
            if (!found && !std::exchange(no_feed_said_, true)) {
                fault(source, "a feed move without a feed, or with a spindle that stands");
            }
            if (!found) {
                return;
            }
            duration = *found;
        }
        Block& block = add(kind, source);
        block.named = AxisSet::all(machine_.axis_count());
        block.duration = duration;
        block.path = path_;
        for (int n = 0; n < machine_.axis_count(); ++n) {
            const kinematics::MachineAxis& axis = machine_.axis(n);
            const double value = end[index_of(axis.letter)];
            block.target[n] = axis.kind == kinematics::AxisKind::rotary ? from_degrees(value) : value;
        }
        const double way = linear_distance(at_, end);
        block.feed = duration > 0.0 ? way / duration : 0.0;
        result_.length += way;
        at_ = end;
    }
};

MachineProgramBuilder::MachineProgramBuilder(const kinematics::MachineModel& machine,
                                             std::filesystem::path file,
                                             const MachineProgramSettings& settings)
    : parts_(std::make_unique<Parts>(machine, std::move(file), settings)) {}

MachineProgramBuilder::~MachineProgramBuilder() = default;

void MachineProgramBuilder::move(const Move& move, const SourceLine&) {
    parts_->move(move);
}

void MachineProgramBuilder::curve(const Curve& curve, const SourceLine&) {
    parts_->curve(curve);
}

void MachineProgramBuilder::command(const Command& command, const SourceLine&) {
    parts_->command(command);
}

MachineProgram MachineProgramBuilder::take() {
    return parts_->take();
}

} // namespace millwright::gcode
