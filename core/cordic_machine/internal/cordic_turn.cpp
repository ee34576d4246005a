#include "core/cordic_machine/internal/cordic_turn.h"

#include <algorithm>

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

} // namespace millwright::cordic_machine::internal
