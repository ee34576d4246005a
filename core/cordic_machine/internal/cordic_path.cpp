#include "core/cordic_machine/internal/cordic_path.h"

#include "core/base/numbers.h"
#include "core/gcode_programs/programmed_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::cordic_machine::internal {

HeldPlace held(const cordic::ChordEndModel& chord_ends, const cordic::PlaceWords& words) {
    return {words, {chord_ends.number(words.x), chord_ends.number(words.y), chord_ends.number(words.z)}};
}

double CordicTurn::sagitta() const {
    const double quarter = 0.25 * sweep / static_cast<double>(chords);
    return 2.0 * radius() * std::pow(std::sin(quarter), 2);
}

Place3 CordicTurn::at(std::int64_t k) const {
    const double share = static_cast<double>(k) / static_cast<double>(chords);
    const double c = std::cos(sweep * share);
    const double s = std::sin(sweep * share);
    const double dx = from.x - about.x;
    const double dy = from.y - about.y;
    return {about.x + dx * c - dy * s, about.y + dx * s + dy * c, about.z + rise * share};
}

Rotations rotations_within(const cordic::ChordEndModel& chord_ends,
                           const cordic::ArcWords& words,
                           const CordicTurn& turn,
                           const HeldPlace& from,
                           std::int64_t k,
                           std::int64_t most,
                           double slack) {
    Rotations done{.end = from};
    while (done.count < most) {
        const auto next = chord_ends.next(words, done.end.words);
        if (!next || *next == done.end.words || !chord_ends.reaches(done.end.words, *next)) {
            break;
        }
        const HeldPlace end = held(chord_ends, *next);
        done.aside = std::max(done.aside, distance(end.place, turn.at(k + done.count + 1)));
        if (done.aside > slack) {
            break;
        }
        done.end = end;
        ++done.count;
    }
    return done;
}

using cordic::ArcWords;
using cordic::Opcode;
using cordic::Register;
using cordic::Word;

namespace {

constexpr const char* finer = "choose a number format with more fraction bits, or a larger tolerance";

/// Fewer rotations than these are not worth loading the registers of an arc.
constexpr std::int64_t least_rotations = 2;

/// Numbers of chords, one of which an arc gets.
constexpr std::int64_t most_tried = 64;

} // namespace

CordicPath::CordicPath(const CordicProgramSettings& settings, CordicCode& code, const Place3& start)
    : settings_(settings), turner_(settings.format, settings.processor), code_(code), at_(start) {
    const auto x = start_word(Register::X0, start.x, "X of the start");
    const auto y = start_word(Register::Y0, start.y, "Y of the start");
    const auto z = start_word(Register::Z0, start.z, "Z of the start");
    held_ = held(turner_, {x.value_or(0), y.value_or(0), z.value_or(0)});
}

/// The processor is at zero after reset.
std::optional<Word> CordicPath::start_word(Register target, double value, std::string_view what) {
    const auto word = code_.number(value, what, {});
    if (word && !exactly_equal(value, 0.0)) {
        code_.mov(target, *word);
    }
    return word;
}

/// Nothing, and a fault, where the format cannot hold it.
std::optional<HeldPlace> CordicPath::held_at(const Place3& place, gcode::SourcePlace source) {
    const auto x = code_.number(place.x, "X", {source, 'X'});
    const auto y = code_.number(place.y, "Y", {source, 'Y'});
    const auto z = code_.number(place.z, "Z", {source, 'Z'});
    return x && y && z ? std::optional(held(turner_, {*x, *y, *z})) : std::nullopt;
}

bool CordicPath::is_held(const HeldPlace& to) const {
    return exactly_equal(to.place.x, held_.place.x) && exactly_equal(to.place.y, held_.place.y) &&
           exactly_equal(to.place.z, held_.place.z);
}

bool CordicPath::load(Register target, double value, std::string_view what, const FaultyWord& word) {
    const auto found = code_.number(value, what, word);
    if (found && value > 0.0 && !(turner_.number(*found) > 0.0)) {
        code_.fault(
            word,
            fmt::format("{} {:.3g} is below the resolution of {}", what, value, to_text(settings_.format)),
            "choose a number format with more fraction bits");
        return false;
    }
    if (found) {
        code_.mov(target, *found);
    }
    return found.has_value();
}

bool CordicPath::load_speed(const FeedOf& feed) {
    return load(Register::Vmax, feed.speed, "the speed in mm/s", {feed.source, 'F'}) &&
           load(Register::Amax, settings_.acceleration, "the acceleration in mm/s2", {feed.source});
}

void CordicPath::line(const LineOpcodes& opcodes, const Place3& to, const FeedOf& feed) {
    const auto wanted = held_at(to, feed.source);
    if (!wanted) {
        return;
    }
    const double length = distance(to, at_);
    at_ = to;
    if (!is_held(*wanted)) {
        go(opcodes, *wanted, to, feed);
    } else if (length > gcode::same_place) {
        code_.warn({feed.source},
                   fmt::format("a move of {:.3g} mm is below the resolution of {} and is skipped",
                               length,
                               to_text(settings_.format)));
    } else {
        code_.warn({feed.source}, "a move of zero length is skipped");
    }
}

void CordicPath::go(const LineOpcodes& opcodes,
                    const HeldPlace& to,
                    const Place3& exact,
                    const FeedOf& feed) {
    if (!turner_.reaches(held_.words, to.words)) {
        code_.fault({feed.source, 'G'},
                    fmt::format("the direction of a line cannot be reached with {} iterations",
                                settings_.processor.sequence.step_count),
                    "use 4 or more iterations");
        held_ = to;
        return;
    }
    if (!load_speed(feed)) {
        return;
    }
    code_.mov(Register::XI, to.words.x);
    code_.mov(Register::YJ, to.words.y);
    const bool level = exactly_equal(to.place.z, held_.place.z);
    if (!level) {
        code_.mov(Register::Z, to.words.z);
    }
    code_.op(level ? opcodes.plane : opcodes.space);
    publish(exact, feed);
    held_ = to;
}

void CordicPath::publish(const Place3& to, const FeedOf& feed) {
    code_.result().points.push_back({to.x, to.y, feed.speed, feed.source.line, to.z});
}

bool CordicPath::chord(const Place3& to, const FeedOf& feed, double slack) {
    const auto wanted = held_at(to, feed.source);
    if (!wanted) {
        return false;
    }
    at_ = to;
    const double aside = distance(wanted->place, to);
    if (aside > slack) {
        code_.fault({feed.source, 'G'},
                    fmt::format("in {} the end of a chord is {:.3g} mm off, too much for a chord tolerance "
                                "of {:.3g} mm, which leaves {:.3g} mm for rounding",
                                to_text(settings_.format),
                                aside,
                                settings_.chord_tolerance,
                                slack),
                    finer);
        return false;
    }
    if (!is_held(*wanted)) {
        go({}, *wanted, to, feed);
    }
    return true;
}

void CordicPath::arc(const CordicTurn& turn, const Place3& end, const FeedOf& feed) {
    const bool rotated = settings_.arc_end == ArcEnd::rotated && !turn.rises();
    const auto divided = best_divided(turn, rotated, feed.source);
    at_ = end;
    if (divided && rotated) {
        whole_arc(*divided, feed);
    } else if (divided) {
        arc_in_parts(*divided, end, feed);
    }
}

/// In up to a sixteenth more chords, of the angle that the steps turn most exactly, where those of `turn`
/// would be led astray. Nothing, and a fault, where the format cannot hold what the arc is made of.
std::optional<DividedTurn>
CordicPath::best_divided(const CordicTurn& turn, bool rotated, gcode::SourcePlace source) {
    const auto words = words_of(turn, source);
    if (!words) {
        return std::nullopt;
    }
    DividedTurn best{turn, *words};
    const std::int64_t rotations = rotated ? turn.chords : turn.chords - 1;
    if (settings_.lets_arcs_drift ||
        rotations_within(turner_, *words, turn, held_, 0, rotations, slack_of(turn)).count == rotations) {
        return best;
    }
    double least = std::numeric_limits<double>::infinity();
    const std::int64_t most = turn.chords + std::min(turn.chords / 16, most_tried);
    for (CordicTurn tried = turn; tried.chords <= most; ++tried.chords) {
        const double angle = std::abs(tried.sweep) / static_cast<double>(tried.chords);
        const auto dz = code_.number(angle, "the angle of a chord", {source, 'G'});
        const double off = std::abs(turner_.turned(dz.value_or(0)) - angle);
        if (off < least) {
            least = off;
            best.turn = tried;
        }
    }
    best.words = words_of(best.turn, source).value_or(*words);
    return best;
}

std::optional<ArcWords> CordicPath::words_of(const CordicTurn& turn, gcode::SourcePlace source) {
    const auto count = static_cast<double>(turn.chords);
    const auto i = code_.number(turn.about.x, "the centre's X", {source, 'I'});
    const auto j = code_.number(turn.about.y, "the centre's Y", {source, 'J'});
    const auto dz = code_.number(std::abs(turn.sweep) / count, "the angle of a chord", {source, 'G'});
    const auto rise = code_.number(turn.rise / count, "the rise of a chord", {source, 'Z'});
    if (!i || !j || !dz || !rise) {
        return std::nullopt;
    }
    return ArcWords{*i, *j, *dz, *rise, turn.sweep < 0.0};
}

/// All its chords as rotations.
void CordicPath::whole_arc(const DividedTurn& arc, const FeedOf& feed) {
    const auto& [turn, words] = arc;
    const Rotations rotations = rotations_within(turner_, words, turn, held_, 0, turn.chords, slack_of(turn));
    if (rotations.count == turn.chords || settings_.lets_arcs_drift) {
        rotate(arc, 0, {turn.chords, rotations.end}, feed);
        return;
    }
    if (!(rotations.aside > slack_of(turn))) {
        code_.fault({feed.source, 'G'},
                    fmt::format("{} cannot represent the chords of an arc of radius {:.3g} mm",
                                to_text(settings_.format),
                                turn.radius()),
                    "choose a number format with more bits");
        return;
    }
    code_.fault({feed.source, 'G'},
                fmt::format("rounding in {} moves this arc {:.3g} mm off, too much for a chord tolerance of "
                            "{:.3g} mm, whose chords leave {:.3g} mm for rounding",
                            to_text(settings_.format),
                            rotations.aside,
                            settings_.chord_tolerance,
                            slack_of(turn)),
                finer);
}

/// Rotations as far as they stay near their places, then a line to where the next chord ends; and again.
void CordicPath::arc_in_parts(const DividedTurn& arc, const Place3& end, const FeedOf& feed) {
    const auto& [turn, words] = arc;
    const std::size_t points_before = code_.result().points.size();
    for (std::int64_t k = 0; k < turn.chords; ++k) {
        const Rotations rotations = part_of(arc, k);
        if (rotations.count > 0 && !rotate(arc, k, rotations, feed)) {
            return;
        }
        k += rotations.count;
        if (!chord(k + 1 < turn.chords ? turn.at(k + 1) : end, feed, slack_of(turn))) {
            return;
        }
    }
    if (code_.result().points.size() == points_before) {
        code_.warn({feed.source},
                   fmt::format("an arc of radius {:.3g} mm is below the resolution of {} and is skipped",
                               turn.radius(),
                               to_text(settings_.format)));
    }
}

Rotations CordicPath::part_of(const DividedTurn& arc, std::int64_t k) const {
    const auto& [turn, words] = arc;
    const std::int64_t most = turn.chords - 1 - k;
    Rotations found = rotations_within(turner_, words, turn, held_, k, most, slack_of(turn));
    if (settings_.lets_arcs_drift) {
        found.count = most;
    } else if (found.count < std::min(least_rotations, most) || !turns(words)) {
        found.count = 0;
    }
    return found;
}

/// How far the ends of its chords may be from their places.
double CordicPath::slack_of(const CordicTurn& turn) const {
    return settings_.lets_arcs_drift ? std::numeric_limits<double>::infinity()
                                     : settings_.chord_tolerance - turn.sagitta();
}

bool CordicPath::turns(const ArcWords& words) const {
    return turner_.number(words.dz) > 0.0;
}

/// Chords behind the first `k`. False, and a fault, if the format cannot hold what they need.
bool CordicPath::rotate(const DividedTurn& arc,
                        std::int64_t k,
                        const Rotations& rotations,
                        const FeedOf& feed) {
    const auto& [turn, words] = arc;
    if (!turns(words)) {
        code_.fault({feed.source, 'G'},
                    fmt::format("the angle of a chord, {:.3g} rad, is below the resolution of {}",
                                std::abs(turn.sweep) / static_cast<double>(turn.chords),
                                to_text(settings_.format)),
                    finer);
        return false;
    }
    if (!load_speed(feed)) {
        return false;
    }
    code_.mov(Register::XI, words.i);
    code_.mov(Register::YJ, words.j);
    code_.mov(Register::Dz, words.dz);
    code_.mov(Register::N, static_cast<Word>(rotations.count));
    const bool iso = settings_.processor.sense == cordic::ArcSense::iso;
    const bool g02 = words.clockwise == iso;
    if (turn.rises()) {
        code_.mov(Register::Z, words.rise);
        code_.op(g02 ? Opcode::g02z : Opcode::g03z);
    } else {
        code_.op(g02 ? Opcode::g02 : Opcode::g03);
    }
    code_.set_loaded(Register::N, 0); // counted down
    for (std::int64_t n = 1; n <= rotations.count; ++n) {
        publish(turn.at(k + n), feed);
    }
    held_ = rotations.end;
    return true;
}

} // namespace millwright::cordic_machine::internal
