#include "core/gcode/reader/cordic_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/cordic/arithmetic.h"
#include "core/gcode/reader/canon_frame.h"
#include "core/gcode/reader/internal/chords.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::gcode {

namespace {

using cordic::Opcode;
using cordic::Register;
using cordic::Word;

constexpr double seconds_a_minute = 60.0;
constexpr double same_place = 1e-9;              // mm or degrees: rounding of offsets
constexpr double widest_chord = pi / 4;          // rad
constexpr std::int64_t most_chords = 10'000'000; // of one arc: what a person waits for, far below register N

struct Place2 {
    double x = 0.0, y = 0.0;
};

/// What a command is called where the processor cannot do it; empty: it changes nothing that the processor
/// does.
std::string_view refused(CommandKind kind) {
    switch (kind) {
    case CommandKind::dwell:
        return "dwell";
    case CommandKind::start_spindle_clockwise:
    case CommandKind::start_spindle_counterclockwise:
    case CommandKind::orient_spindle:
        return "spindle";
    case CommandKind::mist_on:
    case CommandKind::flood_on:
        return "coolant";
    case CommandKind::change_tool:
    case CommandKind::change_tool_number:
        return "tool change";
    case CommandKind::program_stop:
    case CommandKind::optional_program_stop:
        return "program stop";
    case CommandKind::start_speed_feed_synch:
        return "feed a revolution";
    case CommandKind::wait_input:
        return "input";
    case CommandKind::set_motion_output_bit:
    case CommandKind::set_aux_output_bit:
    case CommandKind::set_motion_output_value:
    case CommandKind::set_aux_output_value:
        return "output";
    default:
        return {};
    }
}

} // namespace

std::int64_t chord_count(double radius, double sweep, double tolerance) {
    expects(radius > 0.0 && tolerance > 0.0, "an arc has a radius and its chords a tolerance");
    const double widest = 2.0 * std::acos(std::max(1.0 - tolerance / radius, 0.0));
    const double angle = std::min(widest, widest_chord);
    const double count = angle > 0.0 ? std::ceil(std::abs(sweep) / angle) : 1e18;
    return static_cast<std::int64_t>(std::clamp(count, 1.0, 1e18));
}

class CordicProgramBuilder::Parts {
public:
    Parts(std::filesystem::path file, const CordicProgramSettings& settings)
        : file_(std::move(file)), settings_(settings) {
        expects(settings.chord_tolerance > 0.0, "a chord tolerance is positive");
        result_.image.format = settings.format;
    }

    void move(const Move& move) {
        const AxisValues end = frame_.to_machine(move.target);
        switch (move.kind) {
        case MoveKind::traverse:
            return line(Opcode::g00, end, settings_.rapid_speed, move.source);
        case MoveKind::feed:
            return line(Opcode::g01, end, feed_, move.source);
        case MoveKind::arc:
            return arc(move, end);
        case MoveKind::probe:
            return fault(move.source, "the CORDIC processor cannot probe");
        case MoveKind::rigid_tap:
            return fault(move.source, "the CORDIC processor cannot tap");
        }
    }

    void curve(const Curve& curve) {
        const AxisValues start = frame_.from_machine(at_);
        internal::curve_chords(
            start, curve, settings_.chord_tolerance / frame_.unit(), [&](const AxisValues& end) {
                line(Opcode::g01, frame_.to_machine(end), feed_, curve.source);
            });
    }

    void command(const Command& command) {
        frame_.command(command);
        if (command.kind == CommandKind::set_feed_rate) {
            feed_ = command.value * frame_.unit() / seconds_a_minute;
        }
        if (const auto what = refused(command.kind); !what.empty()) {
            fault(command.source, fmt::format("the CORDIC processor has no {}", what));
        }
    }

    CordicProgram take() {
        op(Opcode::hlt);
        if (result_.image.code.size() > cordic::rom_size) {
            fault({},
                  fmt::format("the program needs {} bytes, the program ROM holds {}",
                              result_.image.code.size(),
                              cordic::rom_size));
        }
        return std::move(result_);
    }

private:
    std::filesystem::path file_;
    CordicProgramSettings settings_;
    CordicProgram result_;
    CanonFrame frame_;
    AxisValues at_;     ///< on the machine, mm and degrees
    double feed_ = 0.0; ///< mm/s
    std::array<std::optional<Word>, cordic::register_count>
        loaded_; ///< what the program left in the registers

    void fault(SourcePlace source, std::string message, std::string hint = {}) {
        if (result_.faults.size() < settings_.most_faults) {
            result_.faults.push_back({{file_, source.line, 0, -1}, std::move(message), std::move(hint)});
        }
    }

    /// The bits of a number; nothing, and a fault, if it does not fit.
    std::optional<Word> number(double value, std::string_view what, SourcePlace source) {
        bool overflow = false;
        const Word word = cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
            return arithmetic.to_word(arithmetic.from_double(value, overflow));
        });
        if (overflow) {
            fault(source,
                  fmt::format("{} {} does not fit into {}", what, value, cordic::to_text(settings_.format)),
                  "choose a number format with more bits before the point");
            return std::nullopt;
        }
        return word;
    }
    [[nodiscard]] double as_held(Word word) const {
        return cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
            return arithmetic.to_double(arithmetic.from_word(word));
        });
    }

    void op(Opcode opcode) { cordic::append(result_.image.code, {.opcode = opcode}, settings_.format); }
    /// Loads a register unless the program left that in it.
    void mov(Register target, Word word) {
        auto& loaded = loaded_[static_cast<std::size_t>(target)];
        if (loaded != word) {
            const Word immediate =
                cordic::is_whole(target) ? word : cordic::to_immediate(settings_.format, word);
            cordic::append(result_.image.code, {Opcode::mov, target, immediate}, settings_.format);
            loaded = word;
        }
    }

    /// True if only X and Y go somewhere.
    bool is_flat(const AxisValues& end, SourcePlace source) {
        if (settings_.leaves_out_other_axes) {
            return true;
        }
        for (std::size_t n = 2; n < axis_count; ++n) {
            if (std::abs(end[n] - at_[n]) > same_place) {
                fault(source, fmt::format("the CORDIC processor has no axis {}", axis_letters[n]));
                at_[n] = end[n]; // said once for each such move
                return false;
            }
        }
        return true;
    }

    bool load_speed(double speed, SourcePlace source) {
        const auto v = number(speed, "the speed", source);
        const auto a = number(settings_.acceleration, "the acceleration", source);
        if (!v || !a) {
            return false;
        }
        mov(Register::Vmax, *v);
        mov(Register::Amax, *a);
        return true;
    }

    void line(Opcode opcode, const AxisValues& end, double speed, SourcePlace source) {
        if (!is_flat(end, source)) {
            return;
        }
        const Place2 to{end[Axis::x], end[Axis::y]};
        const auto x = number(to.x, "X", source);
        const auto y = number(to.y, "Y", source);
        if (!x || !y) {
            return;
        }
        const Place2 held{as_held(*x), as_held(*y)};
        if (held_ && exactly_equal(held.x, held_->x) && exactly_equal(held.y, held_->y)) {
            warn_of_no_length(to, source);
        } else if (load_speed(speed, source)) {
            mov(Register::XI, *x);
            mov(Register::YJ, *y);
            op(opcode);
            publish(to, speed, source);
            held_ = held;
        }
        at_ = end;
    }
    void warn_of_no_length(const Place2& to, SourcePlace source) {
        const double length = std::hypot(to.x - at_[Axis::x], to.y - at_[Axis::y]);
        if (length > same_place) {
            result_.warnings.push_back(
                {{file_, source.line, 0, -1},
                 fmt::format("a move of {:.3g} mm is less than {} can tell and is left out",
                             length,
                             cordic::to_text(settings_.format)),
                 {}});
        } else {
            result_.warnings.push_back(
                {{file_, source.line, 0, -1}, "a move without length is left out", {}});
        }
    }
    void publish(const Place2& to, double speed, SourcePlace source) {
        result_.points.push_back({to.x, to.y, speed, source.line});
    }

    void arc(const Move& move, const AxisValues& end) {
        if (move.plane != Plane::xy) {
            return fault(move.source, "the CORDIC processor turns arcs in the XY plane alone (G17)");
        }
        if (!is_flat(end, move.source)) {
            return;
        }
        AxisValues centre_in_program = move.target;
        centre_in_program[Axis::x] = move.centre_1;
        centre_in_program[Axis::y] = move.centre_2;
        const AxisValues centre = frame_.to_machine(centre_in_program);
        const Place2 about{centre[Axis::x], centre[Axis::y]};
        const double radius = std::hypot(at_[Axis::x] - about.x, at_[Axis::y] - about.y);
        const std::int64_t chords = chord_count(radius, move.sweep, settings_.chord_tolerance);
        const bool rotated = settings_.arc_end == ArcEnd::rotated;
        const std::int64_t rotations = rotated ? chords : chords - 1;
        if (rotations > most_chords) {
            return fault(
                move.source, fmt::format("an arc of {} chords", chords), "choose a larger chord tolerance");
        }
        if (rotations > 0 && !rotate(about, move, rotations, chords)) {
            return;
        }
        held_.reset();
        if (rotated) {
            at_ = end;
        } else {
            line(Opcode::g01, end, feed_, move.source);
        }
    }
    /// `rotations` chords of sweep / chords each.
    bool rotate(const Place2& about, const Move& move, std::int64_t rotations, std::int64_t chords) {
        const double step = move.sweep / static_cast<double>(chords);
        const auto i = number(about.x, "I", move.source);
        const auto j = number(about.y, "J", move.source);
        const auto dz = number(std::abs(step), "the angle of a chord", move.source);
        if (!i || !j || !dz || !load_speed(feed_, move.source)) {
            return false;
        }
        mov(Register::XI, *i);
        mov(Register::YJ, *j);
        mov(Register::Dz, *dz);
        mov(Register::N, static_cast<Word>(rotations));
        op(move.sweep < 0.0 ? Opcode::g02 : Opcode::g03);
        loaded_[static_cast<std::size_t>(Register::N)] = 0; // counted down
        const double dx = at_[Axis::x] - about.x;
        const double dy = at_[Axis::y] - about.y;
        for (std::int64_t k = 1; k <= rotations; ++k) {
            const double angle = step * static_cast<double>(k);
            publish({about.x + dx * std::cos(angle) - dy * std::sin(angle),
                     about.y + dx * std::sin(angle) + dy * std::cos(angle)},
                    feed_,
                    move.source);
        }
        return true;
    }

    /// Where the processor stands, as its format holds it; unknown behind rotations.
    std::optional<Place2> held_ = Place2{};
};

CordicProgramBuilder::CordicProgramBuilder(std::filesystem::path file, const CordicProgramSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(file), settings)) {}

CordicProgramBuilder::~CordicProgramBuilder() = default;

void CordicProgramBuilder::move(const Move& move, const SourceLine&) {
    parts_->move(move);
}

void CordicProgramBuilder::curve(const Curve& curve, const SourceLine&) {
    parts_->curve(curve);
}

void CordicProgramBuilder::command(const Command& command, const SourceLine&) {
    parts_->command(command);
}

CordicProgram CordicProgramBuilder::take() {
    return parts_->take();
}

} // namespace millwright::gcode
