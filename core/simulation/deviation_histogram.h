// How much of the part's area deviates by how much. Lengths mm.
#pragma once

#include "core/simulation/comparison.h"

#include <span>
#include <vector>

namespace millwright::simulation {

/// Bins of equal width from -range to range; those at the ends have all that is beyond, too.
struct DeviationHistogram {
    double range = 0.0;         ///< > 0
    std::vector<double> shares; ///< of the area of all points, 0 to 1; their sum is 1, or 0 without area

    /// In the middle of a bin.
    [[nodiscard]] double height(std::size_t bin) const {
        return range * (2.0 * (static_cast<double>(bin) + 0.5) / static_cast<double>(shares.size()) - 1.0);
    }
};

/// Throws Defect unless there is a deviation for each point, a bin and a range above 0.
[[nodiscard]] DeviationHistogram histogram_of(std::span<const PartPoint> points,
                                              std::span<const Deviation> deviations,
                                              double range,
                                              int bins);

/// A range in which the colours of `tolerance` can be told apart, and in which nearly all deviations lie: a
/// round number.
[[nodiscard]] double histogram_range(std::span<const Deviation> deviations, double tolerance);

} // namespace millwright::simulation
