// The instructions of lines and arcs along X, Y and Z. It knows where each instruction leaves the processor,
// bit by bit, and so divides arcs where rounding would lead them astray.
#pragma once

#include "core/cordic/chord_end_model.h"
#include "core/cordic_machine/internal/cordic_code.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace millwright::cordic_machine::internal {

// An arc or a helix as the CORDIC processor goes along it: chord by chord, each turned from the end of the
// one before, whose rounding it inherits.

/// mm
struct Place3 {
    double x = 0.0, y = 0.0, z = 0.0;
};

[[nodiscard]] inline double distance(const Place3& a, const Place3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// A place as a number format holds it.
struct HeldPlace {
    cordic::PlaceWords words;
    Place3 place;
};

[[nodiscard]] HeldPlace held(const cordic::ChordEndModel& chord_ends, const cordic::PlaceWords& words);

struct CordicTurn {
    Place3 from;
    Place3 about;       ///< at the height of `from`
    double sweep = 0.0; ///< rad, counter-clockwise
    double rise = 0.0;  ///< of all of it
    std::int64_t chords = 1;

    [[nodiscard]] bool rises() const { return std::abs(rise) > 0.0; }
    [[nodiscard]] double radius() const { return std::hypot(from.x - about.x, from.y - about.y); }
    /// How far a chord is from the arc in its middle.
    [[nodiscard]] double sagitta() const;
    /// Where `k` chords lead in exact arithmetic.
    [[nodiscard]] Place3 at(std::int64_t k) const;
};

/// How many chords are turned one after another, and where they really lead.
struct Rotations {
    std::int64_t count = 0;
    HeldPlace end;
    double aside = 0.0; ///< mm: distance of the farthest end from its place, the refused one among them
};

/// As many chords of `turn` behind its first `k` as `chord_ends` turns from `from` without any of them ending
/// farther than `slack` mm from its place, or where it began, at most `most`.
[[nodiscard]] Rotations rotations_within(const cordic::ChordEndModel& chord_ends,
                                         const cordic::ArcWords& words,
                                         const CordicTurn& turn,
                                         const HeldPlace& from,
                                         std::int64_t k,
                                         std::int64_t most,
                                         double slack);

/// Of a motion, and who asked for it.
struct FeedOf {
    double speed = 0.0; ///< mm/s
    gcode::SourcePlace source;
};

/// The instructions of a line in the plane and of one that rises.
struct LineOpcodes {
    cordic::Opcode plane = cordic::Opcode::g01;
    cordic::Opcode space = cordic::Opcode::g01z;
};

/// And its registers.
struct DividedTurn {
    CordicTurn turn;
    cordic::ArcWords words;
};

class CordicPath {
public:
    /// From `start`, which is given to the processor. `code` outlives it.
    CordicPath(const CordicProgramSettings& settings, CordicCode& code, const Place3& start);

    /// A line, or a warning where the format sees none.
    void line(const LineOpcodes& opcodes, const Place3& to, const FeedOf& feed);

    /// A line to the end of a chord. False, and a fault, where the format holds that farther than `slack` mm
    /// from its place.
    bool chord(const Place3& to, const FeedOf& feed, double slack);

    /// From where the path is to `end`, or to where all its rotations lead. In more chords than `turn` has
    /// where the processor turns those more exactly.
    void arc(const CordicTurn& turn, const Place3& end, const FeedOf& feed);

    [[nodiscard]] const Place3& at() const { return at_; }

private:
    std::optional<cordic::Word> start_word(cordic::Register target, double value, std::string_view what);
    std::optional<HeldPlace> held_at(const Place3& place, gcode::SourcePlace source);
    [[nodiscard]] bool is_held(const HeldPlace& to) const;
    bool load(cordic::Register target, double value, std::string_view what, const FaultyWord& word);
    bool load_speed(const FeedOf& feed);
    void go(const LineOpcodes& opcodes, const HeldPlace& to, const Place3& exact, const FeedOf& feed);
    void publish(const Place3& to, const FeedOf& feed);

    std::optional<cordic::ArcWords> words_of(const CordicTurn& turn, gcode::SourcePlace source);
    std::optional<DividedTurn> best_divided(const CordicTurn& turn, bool rotated, gcode::SourcePlace source);
    void whole_arc(const DividedTurn& arc, const FeedOf& feed);
    void arc_in_parts(const DividedTurn& arc, const Place3& end, const FeedOf& feed);
    [[nodiscard]] Rotations part_of(const DividedTurn& arc, std::int64_t k) const;
    [[nodiscard]] double slack_of(const CordicTurn& turn) const;
    [[nodiscard]] bool turns(const cordic::ArcWords& words) const;
    bool rotate(const DividedTurn& arc, std::int64_t k, const Rotations& rotations, const FeedOf& feed);

    CordicProgramSettings settings_;
    cordic::ChordEndModel turner_;
    CordicCode& code_;
    Place3 at_;      ///< as the program has it
    HeldPlace held_; ///< as the processor has it
};

} // namespace millwright::cordic_machine::internal
