#include "core/cordic_machine/cordic_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic_machine/internal/cordic_code.h"
#include "core/cordic_machine/internal/cordic_path.h"
#include "core/gcode/canon_frame.h"
#include "core/gcode_programs/cut_program.h"
#include "core/gcode_programs/placement.h"
#include "core/gcode_programs/programmed_feed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::cordic_machine {

namespace {

using cordic::Opcode;
using gcode::same_place;
using internal::FeedOf;
using internal::LineOpcodes;
using internal::Place3;

constexpr double widest_chord = pi / 4;         // rad
constexpr std::int64_t most_chords = 2'000'000; // of one arc: what a person waits for, far below register N

Place3 place_of(const gcode::AxisValues& values) {
    return {values[gcode::Axis::x], values[gcode::Axis::y], values[gcode::Axis::z]};
}

/// What of the chord tolerance the chords use; the rest is for the rounding of their ends.
constexpr double share_of_chords = 7.0 / 8.0;

} // namespace

std::int64_t chord_count(double radius, double sweep, double tolerance) {
    expects(radius > 0.0 && tolerance > 0.0, "an arc has a radius and its chords a tolerance");
    const double widest = 4.0 * std::asin(std::min(std::sqrt(0.5 * tolerance / radius), 1.0));
    const double angle = std::min(widest, widest_chord);
    const double count = angle > 0.0 ? std::ceil(std::abs(sweep) / angle) : 1e18;
    return static_cast<std::int64_t>(std::clamp(count, 1.0, 1e18));
}

class CordicProgramBuilder::Parts {
public:
    Parts(std::filesystem::path file, const CordicProgramSettings& settings)
        : settings_(settings), code_(file, settings), path_(settings, code_, place_of(settings.start)),
          placement_(machine_, std::move(file), true), at_(settings.start) {
        expects(settings.chord_tolerance > 0.0, "a chord tolerance is positive");
    }

    void begin_line(const gcode::SourceLine& now) { code_.begin_line(now); }

    void move(const gcode::Move& move, std::string_view line_text) {
        const gcode::AxisValues end = frame_.to_machine(move.target);
        placement_.move(move, at_, end, line_text);
        switch (move.kind) {
        case gcode::MoveKind::traverse:
            return line({Opcode::g00, Opcode::g00z}, end, settings_.rapid_speed, move.source);
        case gcode::MoveKind::feed:
            if (const auto speed = feed_speed(move.source)) {
                line({Opcode::g01, Opcode::g01z}, end, *speed, move.source);
            }
            return;
        case gcode::MoveKind::arc:
            return move.plane == gcode::Plane::xy ? arc(move, end) : arc_in_chords(move);
        case gcode::MoveKind::probe:
            return code_.fault({move.source, 'G'}, "the CORDIC processor cannot probe");
        case gcode::MoveKind::rigid_tap:
            return code_.fault({move.source, 'G'}, "the CORDIC processor cannot tap");
        }
    }

    void curve(const gcode::Curve& curve, std::string_view line_text) {
        placement_.curve(curve.source, line_text);
        const gcode::AxisValues start = frame_.from_machine(at_);
        if (const auto speed = feed_speed(curve.source)) {
            gcode::curve_chords(start,
                                curve,
                                tolerance_of_chords() / frame_.unit(),
                                ChordLines{*this, {*speed, curve.source}});
        }
    }

    void command(const gcode::Command& command, std::string_view line_text) {
        frame_.command(command);
        placement_.command(command, line_text);
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
                        fmt::format("the program needs {} pages of {} bytes, but the program ROM has only {}",
                                    pages,
                                    cordic::rom_size,
                                    settings_.rom_pages));
        }
        CordicProgram made = code_.take();
        made.unplaced = placement_.take_unplaced();
        return made;
    }

private:
    CordicProgramSettings settings_;
    internal::CordicCode code_;
    internal::CordicPath path_;
    internal::CordicCommands commands_{code_};
    gcode::CanonFrame frame_;
    gcode::ProgrammedFeed feed_;
    kinematics::MachineModel machine_ = gcode::xyz_machine();
    gcode::Placement placement_;
    gcode::AxisValues at_; ///< on the machine, mm and degrees

    /// True if only X, Y and Z go somewhere.
    bool is_inside(const gcode::AxisValues& end, gcode::SourcePlace source) {
        if (settings_.leaves_out_other_axes) {
            return true;
        }
        std::vector<char> missing;
        for (std::size_t n = 3; n < gcode::axis_count; ++n) {
            if (std::abs(end[n] - at_[n]) > same_place) {
                missing.push_back(gcode::axis_letters[n]);
                at_[n] = end[n]; // said once for each such move
            }
        }
        if (!missing.empty()) {
            code_.fault({source, missing.front()},
                        fmt::format("the CORDIC processor has no axis {}", fmt::join(missing, " or ")),
                        "use only X, Y and Z");
        }
        return missing.empty();
    }

    /// mm/s; nothing, and a fault, where it is not known.
    std::optional<double> feed_speed(gcode::SourcePlace source) {
        const auto speed = feed_.speed();
        if (!speed) {
            code_.fault(
                {source, 'G'},
                "feed per revolution (G95) cannot be used with a spindle that follows the diameter (G96)",
                "use G97 (constant spindle speed)");
        }
        return speed;
    }

    void
    line(const LineOpcodes& opcodes, const gcode::AxisValues& end, double speed, gcode::SourcePlace source) {
        if (is_inside(end, source)) {
            path_.line(opcodes, place_of(end), {speed, source});
            at_ = end;
        }
    }

    /// Takes the ends of chords, in the program's frame, as lines.
    struct ChordLines {
        Parts& parts;
        FeedOf feed;
        bool goes_on = true;

        void operator()(const gcode::AxisValues& end) {
            goes_on = goes_on && parts.chord(parts.frame_.to_machine(end), feed);
        }
    };
    bool chord(const gcode::AxisValues& end, const FeedOf& feed) {
        if (!is_inside(end, feed.source)) {
            return false;
        }
        at_ = end;
        const double slack = settings_.chord_tolerance - tolerance_of_chords();
        return path_.chord(
            place_of(end), feed, settings_.lets_arcs_drift ? std::numeric_limits<double>::infinity() : slack);
    }
    /// mm: all of it where nothing is kept for rounding.
    [[nodiscard]] double tolerance_of_chords() const {
        return (settings_.lets_arcs_drift ? 1.0 : share_of_chords) * settings_.chord_tolerance;
    }

    /// In the other planes: the processor turns about Z alone.
    void arc_in_chords(const gcode::Move& move) {
        const gcode::AxisValues start = frame_.from_machine(at_);
        const double radius = frame_.unit() * gcode::arc_radius(start, move);
        const auto speed = feed_speed(move.source);
        if (speed && chords_of(radius, move)) {
            gcode::arc_chords(
                start, move, tolerance_of_chords() / frame_.unit(), ChordLines{*this, {*speed, move.source}});
        }
    }

    /// Nothing, and a fault, if they are more than anybody waits for.
    std::optional<std::int64_t> chords_of(double radius, const gcode::Move& move) {
        warn_of_hair(radius, move);
        const std::int64_t chords = chord_count(radius, move.sweep, tolerance_of_chords());
        if (chords > most_chords) {
            code_.fault({move.source, 'G'},
                        fmt::format("an arc would need {} chords", chords),
                        "use a larger chord tolerance");
            return std::nullopt;
        }
        return chords;
    }

    /// An end so near behind the start is taken as the start itself.
    void warn_of_hair(double radius, const gcode::Move& move) {
        const double behind = std::fmod(std::abs(move.sweep), 2.0 * pi);
        if (behind < gcode::hair_sweep && behind * radius > same_place) {
            code_.warn({move.source},
                       fmt::format("the arc ends {:.3g} mm, {:.2g} rad, past its start and is run as a full "
                                   "circle, because less than {:.0e} rad does not count as a sweep",
                                   behind * radius,
                                   behind,
                                   gcode::hair_sweep));
        }
    }

    void arc(const gcode::Move& move, const gcode::AxisValues& end) {
        if (!is_inside(end, move.source)) {
            return;
        }
        gcode::AxisValues centre_in_program = move.target;
        centre_in_program[gcode::Axis::x] = move.centre_1;
        centre_in_program[gcode::Axis::y] = move.centre_2;
        const gcode::AxisValues centre = frame_.to_machine(centre_in_program);
        const Place3 from = path_.at();
        const Place3 about{centre[gcode::Axis::x], centre[gcode::Axis::y], from.z};
        const auto speed = feed_speed(move.source);
        const auto chords = chords_of(internal::distance(from, about), move);
        if (!chords || !speed) {
            return;
        }
        const double rise = end[gcode::Axis::z] - from.z;
        const bool thesis = settings_.processor.sense == cordic::ArcSense::thesis;
        path_.arc({.from = from,
                   .about = about,
                   .sweep = thesis ? -move.sweep : move.sweep,
                   .rise = std::abs(rise) > same_place ? rise : 0.0,
                   .chords = *chords},
                  place_of(end),
                  {*speed, move.source});
        at_ = end;
    }
};

namespace {

/// Empty where another line brought what `source` asked for.
std::string_view line_asking_for(const gcode::SourceLine& now, gcode::SourcePlace source) {
    return now.place == source ? now.text : std::string_view();
}

} // namespace

CordicProgramBuilder::CordicProgramBuilder(std::filesystem::path file, const CordicProgramSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(file), settings)) {}

CordicProgramBuilder::~CordicProgramBuilder() = default;

void CordicProgramBuilder::move(const gcode::Move& move, const gcode::SourceLine& now) {
    parts_->begin_line(now);
    parts_->move(move, line_asking_for(now, move.source));
}

void CordicProgramBuilder::curve(const gcode::Curve& curve, const gcode::SourceLine& now) {
    parts_->begin_line(now);
    parts_->curve(curve, line_asking_for(now, curve.source));
}

void CordicProgramBuilder::command(const gcode::Command& command, const gcode::SourceLine& now) {
    parts_->begin_line(now);
    parts_->command(command, line_asking_for(now, command.source));
}

CordicProgram CordicProgramBuilder::take() {
    return parts_->take();
}

} // namespace millwright::cordic_machine
