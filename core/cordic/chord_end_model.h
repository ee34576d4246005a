// Where the chords of G02 and G03 end, bit by bit as the processor computes them, without its clocks. The
// errors of chord upon chord add up: the angle as the format holds it, what the steps leave of it, and the
// roundings of the vector. A compiler that turns them beforehand knows them all.
#pragma once

#include "core/cordic/kernel.h"
#include "core/cordic/processor_state.h"

#include <optional>

namespace millwright::cordic {

/// The registers that an arc or a helix is turned by: XI, YJ, Dz and, of a helix, Z.
struct ArcWords {
    Word i = 0, j = 0, dz = 0;
    Word rise = 0;
    bool clockwise = false; ///< as the processor is to turn, whatever it calls that
};

/// X0, Y0 and Z0.
struct PlaceWords {
    Word x = 0, y = 0, z = 0;

    friend bool operator==(const PlaceWords&, const PlaceWords&) = default;
};

class ChordEndModel {
public:
    /// For a processor of these settings, whose way of rounding counts, with a program in `format`.
    ChordEndModel(const NumberFormat& format, const ProcessorSettings& settings);

    /// Where the chord from `from` ends; nothing where the processor would stop: a number on the way does not
    /// fit, or dz is beyond the convergence range.
    [[nodiscard]] std::optional<PlaceWords> next(const ArcWords& arc, const PlaceWords& from) const;

    /// Whether the steps turn the line from one place to the other to the x axis, and its slope; where they
    /// do not, the processor would stop.
    [[nodiscard]] bool reaches(const PlaceWords& from, const PlaceWords& to) const;

    /// The angle, rad, that the steps turn by when asked for dz, which is within the convergence range.
    [[nodiscard]] double turned(Word dz) const;

    /// A register as a number.
    [[nodiscard]] double number(Word word) const;

private:
    AnyKernel kernel_;
};

} // namespace millwright::cordic
