#include "core/simulation/deviation_histogram.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace millwright::simulation {

DeviationHistogram histogram_of(std::span<const PartPoint> points,
                                std::span<const Deviation> deviations,
                                double range,
                                int bins) {
    expects(points.size() == deviations.size(), "every point of the part has a deviation");
    expects(range > 0.0 && bins > 0, "a histogram has a range and bins");
    DeviationHistogram found{range, std::vector<double>(static_cast<std::size_t>(bins), 0.0)};
    double area = 0.0;
    for (std::size_t n = 0; n < points.size(); ++n) {
        const double place = 0.5 * bins * (deviations[n].height / range + 1.0);
        const double bin = std::clamp(std::floor(place), 0.0, static_cast<double>(bins - 1));
        found.shares[static_cast<std::size_t>(bin)] += points[n].area;
        area += points[n].area;
    }
    for (double& share : found.shares) {
        share = area > 0.0 ? share / area : 0.0;
    }
    return found;
}

double histogram_range(std::span<const Deviation> deviations, double tolerance) {
    std::vector<double> sizes;
    sizes.reserve(deviations.size());
    for (const Deviation& deviation : deviations) {
        sizes.push_back(std::abs(deviation.height));
    }
    constexpr double nearly_all = 0.98, least = 1e-3, tolerances = 2.0; // share; mm
    double wanted = std::max(tolerances * tolerance, least);
    if (!sizes.empty()) {
        const auto at =
            sizes.begin() + static_cast<std::ptrdiff_t>(nearly_all * static_cast<double>(sizes.size() - 1));
        std::ranges::nth_element(sizes, at);
        wanted = std::max(wanted, *at);
    }
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * decade >= wanted) {
            return step * decade;
        }
    }
    return 10.0 * decade;
}

} // namespace millwright::simulation
