// How wrong a result can be: a bound that is proven for every input, and what is measured against exact
// arithmetic. The proof is in docs/reference/cordic.md#accuracy; the sequences are circular.
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
    double angle = 0.0;    ///< by which it is turned wrongly, rad
    double gain = 0.0;     ///< |k P - 1|: of the length, as a fraction
    double rounding = 0.0; ///< of x and y
    double total = 0.0;
};

/// For vectors up to `length` and angles within the convergence range. Numbers that overflow are not covered.
[[nodiscard]] RotationBound
rotation_bound(const NumberFormat& format, const Sequence& sequence, double length);

struct VectoringBound {
    double angle = 0.0;  ///< rad; pi if the vector is too short for the format to have a direction
    double length = 0.0; ///< in units of the vector
};

/// For vectors of `length` within the convergence range, as the format holds them.
[[nodiscard]] VectoringBound
vectoring_bound(const NumberFormat& format, const Sequence& sequence, double length);

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
    double angle = 0.0;    ///< largest error of the direction, rad
    double length = 0.0;   ///< largest error of the length
};

/// Rotations of a vector of length 1 and polar forms of it, after folding; exact are the inputs as the format
/// holds them. Fixed point needs 2 bits before the point. The same result on any number of threads. Throws
/// Cancelled.
[[nodiscard]] Accuracy measure_accuracy(const NumberFormat& format,
                                        const Sequence& sequence,
                                        const Sampling& sampling,
                                        const Progress& progress);

} // namespace millwright::cordic
