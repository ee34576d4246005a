#include "core/gcode/reader/cordic_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/cordic/arithmetic.h"
#include "core/gcode/reader/canon_frame.h"
#include "core/gcode/reader/internal/chords.h"
#include "core/gcode/reader/internal/cordic_code.h"
#include "core/gcode/reader/internal/cordic_commands.h"
#include "core/gcode/reader/internal/programmed_feed.h"

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
using internal::same_place;

constexpr double widest_chord = pi / 4;         // rad
constexpr std::int64_t most_chords = 2'000'000; // of one arc: what a person waits for, far below register N

/// The instructions of a line in the plane and of one that rises.
struct LineOpcodes {
    Opcode plane, space;
};
constexpr LineOpcodes feed_line{Opcode::g01, Opcode::g01z};

struct Place3 {
    double x = 0.0, y = 0.0, z = 0.0;
};

/// An arc from where the axes are, or a helix.
struct Turn {
    Place3 about; ///< at the height where it begins
    double sweep = 0.0;
    double rise = 0.0; ///< of all of it
    std::int64_t chords = 1;
    SourcePlace source;

    [[nodiscard]] bool rises() const { return std::abs(rise) > 0.0; }
};

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
        : settings_(settings), code_(std::move(file), settings), at_(settings.start) {
        expects(settings.chord_tolerance > 0.0, "a chord tolerance is positive");
        start();
    }

    void begin_line(const SourceLine& now) { code_.begin_line(now); }

    void move(const Move& move) {
        const AxisValues end = frame_.to_machine(move.target);
        switch (move.kind) {
        case MoveKind::traverse:
            return line({Opcode::g00, Opcode::g00z}, end, settings_.rapid_speed, move.source);
        case MoveKind::feed:
            if (const auto speed = feed_speed(move.source)) {
                line(feed_line, end, *speed, move.source);
            }
            return;
        case MoveKind::arc:
            return move.plane == Plane::xy ? arc(move, end) : arc_in_chords(move);
        case MoveKind::probe:
            return code_.fault({move.source, 'G'}, "the CORDIC processor cannot probe");
        case MoveKind::rigid_tap:
            return code_.fault({move.source, 'G'}, "the CORDIC processor cannot tap");
        }
    }

    void curve(const Curve& curve) {
        const AxisValues start = frame_.from_machine(at_);
        if (const auto speed = feed_speed(curve.source)) {
            internal::curve_chords(
                start, curve, settings_.chord_tolerance / frame_.unit(), [&](const AxisValues& end) {
                    line(feed_line, frame_.to_machine(end), *speed, curve.source);
                });
        }
    }

    void command(const Command& command) {
        frame_.command(command);
        feed_.command(command, frame_.unit());
        commands_.command(command);
    }

    CordicProgram take() {
        if (!commands_.ended()) {
            code_.op(Opcode::hlt);
        }
        const std::size_t pages = cordic::page_count(code_.result().image.code.size());
        if (pages > static_cast<std::size_t>(settings_.rom_pages)) {
            code_.fault({},
                        fmt::format("the program needs {} pages of {} bytes, the program ROM has {}",
                                    pages,
                                    cordic::rom_size,
                                    settings_.rom_pages));
        }
        return std::move(code_.result());
    }

private:
    CordicProgramSettings settings_;
    internal::CordicCode code_;
    internal::CordicCommands commands_{code_};
    CanonFrame frame_;
    internal::ProgrammedFeed feed_;
    AxisValues at_; ///< on the machine, mm and degrees
    /// Of the third axis, as the format holds it; unknown behind the chords of a helix.
    std::optional<double> height_ = 0.0;
    /// Where the processor stands, as its format holds it; unknown behind rotations.
    std::optional<Place3> held_ = Place3{};

    /// The processor is at zero after reset.
    void start() {
        const auto load = [&](Register target, Axis axis, std::string_view what) {
            const auto word = code_.number(at_[axis], what, {});
            if (word && !exactly_equal(at_[axis], 0.0)) {
                code_.mov(target, *word);
            }
            return word ? code_.as_held(*word) : 0.0;
        };
        held_ = {load(Register::X0, Axis::x, "X of the start"),
                 load(Register::Y0, Axis::y, "Y of the start"),
                 load(Register::Z0, Axis::z, "Z of the start")};
        height_ = held_->z;
    }

    /// True if only X, Y and Z go somewhere.
    bool is_inside(const AxisValues& end, SourcePlace source) {
        if (settings_.leaves_out_other_axes) {
            return true;
        }
        for (std::size_t n = 3; n < axis_count; ++n) {
            if (std::abs(end[n] - at_[n]) > same_place) {
                code_.fault({source, axis_letters[n]},
                            fmt::format("the CORDIC processor has no axis {}", axis_letters[n]),
                            "it moves X, Y and Z");
                at_[n] = end[n]; // said once for each such move
                return false;
            }
        }
        return true;
    }

    /// mm/s; nothing, and a fault, where it is not known.
    std::optional<double> feed_speed(SourcePlace source) {
        const auto speed = feed_.speed();
        if (!speed) {
            code_.fault({source, 'G'},
                        "a feed a revolution (G95) of a spindle that follows the diameter (G96)",
                        "G97: turns a minute");
        }
        return speed;
    }

    bool load_speed(double speed, SourcePlace source) {
        const auto v = code_.number(speed, "the speed in mm/s", {source, 'F'});
        const auto a = code_.number(settings_.acceleration, "the acceleration in mm/s2", {source});
        if (!v || !a) {
            return false;
        }
        code_.mov(Register::Vmax, *v);
        code_.mov(Register::Amax, *a);
        return true;
    }

    void line(const LineOpcodes& opcodes, const AxisValues& end, double speed, SourcePlace source) {
        if (!is_inside(end, source)) {
            return;
        }
        const Place3 to{end[Axis::x], end[Axis::y], end[Axis::z]};
        const auto x = code_.number(to.x, "X", {source, 'X'});
        const auto y = code_.number(to.y, "Y", {source, 'Y'});
        const auto z = code_.number(to.z, "Z", {source, 'Z'});
        if (!x || !y || !z) {
            return;
        }
        const Place3 held{code_.as_held(*x), code_.as_held(*y), code_.as_held(*z)};
        const bool level = height_ && exactly_equal(held.z, *height_);
        if (held_ && level && exactly_equal(held.x, held_->x) && exactly_equal(held.y, held_->y)) {
            warn_of_no_length(to, source);
        } else if (load_speed(speed, source)) {
            code_.mov(Register::XI, *x);
            code_.mov(Register::YJ, *y);
            if (!level) {
                code_.mov(Register::Z, *z);
            }
            code_.op(level ? opcodes.plane : opcodes.space);
            publish(to, speed, source);
            held_ = held;
            height_ = held.z;
        }
        at_ = end;
    }
    void warn_of_no_length(const Place3& to, SourcePlace source) {
        const double length = std::hypot(to.x - at_[Axis::x], to.y - at_[Axis::y], to.z - at_[Axis::z]);
        if (length > same_place) {
            code_.warn(source,
                       fmt::format("a move of {:.3g} mm is less than {} can tell and is left out",
                                   length,
                                   cordic::to_text(settings_.format)));
        } else {
            code_.warn(source, "a move without length is left out");
        }
    }
    void publish(const Place3& to, double speed, SourcePlace source) {
        code_.result().points.push_back({to.x, to.y, speed, source.line, to.z});
    }

    /// In the other planes: the processor turns about Z alone.
    void arc_in_chords(const Move& move) {
        const AxisValues start = frame_.from_machine(at_);
        const double radius = frame_.unit() * internal::arc_radius(start, move);
        const auto speed = feed_speed(move.source);
        if (speed && chords_of(radius, move)) {
            internal::arc_chords(
                start, move, settings_.chord_tolerance / frame_.unit(), [&](const AxisValues& end) {
                    line(feed_line, frame_.to_machine(end), *speed, move.source);
                });
        }
    }

    /// Nothing, and a fault, if they are more than anybody waits for.
    std::optional<std::int64_t> chords_of(double radius, const Move& move) {
        const std::int64_t chords = chord_count(radius, move.sweep, settings_.chord_tolerance);
        if (chords > most_chords) {
            code_.fault({move.source, 'G'},
                        fmt::format("an arc of {} chords", chords),
                        "choose a larger chord tolerance");
            return std::nullopt;
        }
        return chords;
    }

    void arc(const Move& move, const AxisValues& end) {
        if (!is_inside(end, move.source)) {
            return;
        }
        AxisValues centre_in_program = move.target;
        centre_in_program[Axis::x] = move.centre_1;
        centre_in_program[Axis::y] = move.centre_2;
        const AxisValues centre = frame_.to_machine(centre_in_program);
        const Place3 about{centre[Axis::x], centre[Axis::y], at_[Axis::z]};
        const double radius = std::hypot(at_[Axis::x] - about.x, at_[Axis::y] - about.y);
        const auto speed = feed_speed(move.source);
        const auto chords = chords_of(radius, move);
        if (!chords || !speed) {
            return;
        }
        const double rise = end[Axis::z] - at_[Axis::z];
        const Turn turn{about, move.sweep, std::abs(rise) > same_place ? rise : 0.0, *chords, move.source};
        const bool rotated = settings_.arc_end == ArcEnd::rotated && !turn.rises();
        const std::int64_t rotations = rotated ? *chords : *chords - 1;
        if (rotations > 0 && !rotate(turn, rotations, *speed)) {
            return;
        }
        held_.reset();
        if (rotated) {
            at_ = end;
        } else {
            line(feed_line, end, *speed, move.source);
        }
    }
    /// Where `k` chords lead from where the axes are.
    [[nodiscard]] Place3 on_arc(const Turn& turn, std::int64_t k) const {
        const double share = static_cast<double>(k) / static_cast<double>(turn.chords);
        const double angle = turn.sweep * share;
        const double dx = at_[Axis::x] - turn.about.x;
        const double dy = at_[Axis::y] - turn.about.y;
        return {turn.about.x + dx * std::cos(angle) - dy * std::sin(angle),
                turn.about.y + dx * std::sin(angle) + dy * std::cos(angle),
                turn.about.z + turn.rise * share};
    }
    /// The first `rotations` of its chords.
    bool rotate(const Turn& turn, std::int64_t rotations, double speed) {
        const auto count = static_cast<double>(turn.chords);
        const auto i = code_.number(turn.about.x, "the centre's X", {turn.source, 'I'});
        const auto j = code_.number(turn.about.y, "the centre's Y", {turn.source, 'J'});
        const auto dz =
            code_.number(std::abs(turn.sweep) / count, "the angle of a chord", {turn.source, 'G'});
        const auto rise = code_.number(turn.rise / count, "the rise of a chord", {turn.source, 'Z'});
        if (!i || !j || !dz || !rise || !load_speed(speed, turn.source)) {
            return false;
        }
        code_.mov(Register::XI, *i);
        code_.mov(Register::YJ, *j);
        code_.mov(Register::Dz, *dz);
        code_.mov(Register::N, static_cast<Word>(rotations));
        const bool clockwise = turn.sweep < 0.0;
        if (turn.rises()) {
            code_.mov(Register::Z, *rise);
            code_.op(clockwise ? Opcode::g02z : Opcode::g03z);
            height_.reset();
        } else {
            code_.op(clockwise ? Opcode::g02 : Opcode::g03);
        }
        code_.set_loaded(Register::N, 0); // counted down
        for (std::int64_t k = 1; k <= rotations; ++k) {
            publish(on_arc(turn, k), speed, turn.source);
        }
        return true;
    }
};

CordicProgramBuilder::CordicProgramBuilder(std::filesystem::path file, const CordicProgramSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(file), settings)) {}

CordicProgramBuilder::~CordicProgramBuilder() = default;

void CordicProgramBuilder::move(const Move& move, const SourceLine& now) {
    parts_->begin_line(now);
    parts_->move(move);
}

void CordicProgramBuilder::curve(const Curve& curve, const SourceLine& now) {
    parts_->begin_line(now);
    parts_->curve(curve);
}

void CordicProgramBuilder::command(const Command& command, const SourceLine& now) {
    parts_->begin_line(now);
    parts_->command(command);
}

CordicProgram CordicProgramBuilder::take() {
    return parts_->take();
}

} // namespace millwright::gcode
