// One pass of CORDIC-R or CORDIC-V in any coordinate system and from any z, as the thesis's MATLAB functions
// compute it: z is not reduced and the vector is not shifted. The results stand beside the closed forms of
// table 3.2. What the steps do not reach is refused, but for z of a circular rotation.
#pragma once

#include "core/cordic/decimal.h"
#include "core/cordic/kernel.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace millwright::cordic {

/// What goes in. z: rad (circular), a plain number (linear), hyperbolic rad.
struct PassInput {
    Mode mode = Mode::rotation;
    Decimal x = 0.0, y = 0.0, z = 0.0;
    bool folds = false; ///< Pre before the pass, and Post behind a rotation; circular only
    SignOfZero zero = SignOfZero::positive;
};

/// x, y and z behind a step or correction, as binary64.
struct PassStep {
    double x = 0.0, y = 0.0, z = 0.0;
    bool corrects = false; ///< a gain correction or the multiplication, not a step
};

/// x, y, z: the nearest binary64 of the registers. The exact values are those of the input as it was given.
struct SinglePass {
    double x = 0.0, y = 0.0, z = 0.0;
    double exact_x = 0.0, exact_y = 0.0, exact_z = 0.0;
    double error = 0.0;   ///< rotation: distance of (x, y) from the exact vector; vectoring: of x
    double z_error = 0.0; ///< vectoring: of z; rotation: what is left of it
    bool f1 = false;      ///< what Pre did; see quadrant_fold.h
    bool f2 = false;
    int quarter_turns = 0; ///< vectoring with folding: the direction is z and so many times pi/2
    int clocks = 0;
    std::array<Word, 3> words{};
    std::vector<PassStep> steps{}; ///< the input to the iteration first
};

/// Throws Error if a number does not fit the format, if the input is beyond the convergence range (the
/// message has it; but see exceeded_range), and for folding in another system than the circular one.
[[nodiscard]] SinglePass
single_pass(const NumberFormat& format, const Sequence& sequence, const PassInput& input);

// A circular rotation takes any z, as the thesis's MATLAB function CORDIC-R does. Beyond the convergence
// range the steps turn the vector by a part of z, and the rest is left.

/// The largest |z| that the steps turn, rad and rounded down to 1e-5, where `input` is a rotation by more;
/// nothing where it is not.
[[nodiscard]] std::optional<double>
exceeded_range(const NumberFormat& format, const Sequence& sequence, const PassInput& input);

/// A sentence without full stop. `range`: what exceeded_range() gave.
[[nodiscard]] std::string unturned_text(const PassInput& input, double range);

} // namespace millwright::cordic
