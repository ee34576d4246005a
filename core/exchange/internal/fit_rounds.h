// Rounds of a fit: least squares, and the parameters of the points corrected in between.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/internal/least_squares.h"

#include <vector>

namespace millwright::exchange {

struct FitRounds {
    geometry::BezierPatch patch;
    int rounds = 0;
    double rms = 0.0; ///< of the points that are fitted, mm
};

/// Every direction alike.
[[nodiscard]] std::vector<Weighted> by_distance(const std::vector<Sample>& samples);

/// Across the patch, and on its outline across that, too; along hardly, which holds the parameters in their
/// places.
[[nodiscard]] std::vector<Weighted> by_tangents(const std::vector<Sample>& samples,
                                                const geometry::BezierPatch& patch);

/// On that side of the square.
[[nodiscard]] Vec2 kept_on(int side, Vec2 uv);

/// Each parameter goes to the nearest point of the patch. The root mean square of the distances, mm. Throws
/// Cancelled.
[[nodiscard]] double correct_parameters(std::vector<Sample>& samples,
                                        const geometry::BezierPatch& patch,
                                        const Progress& progress);

} // namespace millwright::exchange
