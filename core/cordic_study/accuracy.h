// How wrong a result can be: a bound that is proven for every input, and what is measured against exact
// arithmetic. The proof is in docs/reference/cordic.md#accuracy.
#pragma once

#include "core/base/progress.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <cstdint>
#include <optional>

namespace millwright::cordic {

/// Parts of the largest distance between the computed and the exactly rotated vector. Lengths in units of the
/// vector.
struct RotationBound {
    double angle = 0.0;    ///< by which it is turned wrongly, in the unit of z
    double gain = 0.0;     ///< |k P - 1|: of the length, as a fraction
    double rounding = 0.0; ///< of x and y
    double total = 0.0;
};

/// For vectors up to `length` and angles within the convergence range. Numbers that overflow are not covered.
[[nodiscard]] RotationBound
rotation_bound(const NumberFormat& format, const Sequence& sequence, double length);

struct VectoringBound {
    /// In the unit of z. If the vector is too short for the format to have a direction: pi (circular),
    /// infinite (hyperbolic).
    double angle = 0.0;
    double length = 0.0; ///< of the resulting x, in units of the vector
};

/// For vectors within the convergence range, as the format holds them; `size` is their length (circular), or
/// their x with every y that converges (linear, hyperbolic).
[[nodiscard]] VectoringBound
vectoring_bound(const NumberFormat& format, const Sequence& sequence, double size);

/// Which inputs a measurement tries.
struct Sampling {
    /// Random directions and angles, so many; none: every word that an angle can be (fixed point up to 24
    /// bits).
    std::optional<std::int64_t> random;
    std::uint64_t seed = 2002;
};

struct Accuracy {
    std::int64_t count = 0;
    double rotation = 0.0; ///< largest distance from the exactly rotated vector
    double angle = 0.0;    ///< largest error of z behind vectoring
    double length = 0.0;   ///< largest error of x behind vectoring
};

/// Bits before the point that unit vectors, their rotations by every z that converges, and all on the way
/// need.
[[nodiscard]] int measured_integer_bits(CoordinateSystem m);

/// Rotations of a vector of length 1 and, circular, polar forms of it, after folding and reducing; linear and
/// hyperbolic, vectorings of (x, y) with x = 1.2345678 and 1. Inputs are tried up to 0.999 of the convergence
/// range there, and words beyond it are not counted. Exact are the inputs as the format holds them. Fixed
/// point needs measured_integer_bits() before the point. The same result on any number of threads. Throws
/// Cancelled.
[[nodiscard]] Accuracy measure_accuracy(const NumberFormat& format,
                                        const Sequence& sequence,
                                        const Sampling& sampling,
                                        const Progress& progress);

} // namespace millwright::cordic
