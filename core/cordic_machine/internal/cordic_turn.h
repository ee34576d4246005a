// An arc or a helix as the CORDIC processor goes along it: chord by chord, each turned from the end of the
// one before, whose rounding it inherits.
#pragma once

#include "core/cordic/chord_end_model.h"

#include <cmath>
#include <cstdint>

namespace millwright::cordic_machine::internal {

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

} // namespace millwright::cordic_machine::internal
