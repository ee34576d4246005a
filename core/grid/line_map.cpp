#include "core/grid/internal/line_map.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::grid {

namespace {

/// Where target k of `targets` lies among `sources`.
struct LinePlace {
    int first;    ///< source at or before it
    double share; ///< of the next one
};

LinePlace place(int k, int sources, int targets) {
    const auto cells = static_cast<long>(sources) - 1;
    const auto target_cells = static_cast<long>(targets) - 1;
    const long scaled = k * cells;
    const long whole = scaled / target_cells;
    return {static_cast<int>(whole),
            static_cast<double>(scaled - whole * target_cells) / static_cast<double>(target_cells)};
}

} // namespace

void LineMap::append(int first, std::span<const double> weights) {
    first_.push_back(first);
    weights_.insert(weights_.end(), weights.begin(), weights.end());
    begin_.push_back(weights_.size());
}

LineMap LineMap::interpolation(int sources, int targets) {
    expects(sources >= 2 && targets >= 2, "values on a line have two ends");
    LineMap map;
    map.sources_ = sources;
    for (int k = 0; k < targets; ++k) {
        const LinePlace at = place(k, sources, targets);
        if (at.share > 0.0) {
            map.append(at.first, std::array{1.0 - at.share, at.share});
        } else {
            map.append(at.first, std::array{1.0});
        }
    }
    return map;
}

LineMap LineMap::means(int sources, int targets) {
    expects(sources >= targets, "there are no more means than values");
    const LineMap back = interpolation(targets, sources);
    LineMap map;
    map.sources_ = sources;
    for (int k = 0; k < targets; ++k) {
        int first = 0;
        double sum = 0.0;
        std::vector<double> weights;
        for (int source = 0; source < sources; ++source) {
            const Sum terms = back.at(source);
            const int term = k - terms.first;
            if (term < 0 || term >= std::ssize(terms.weights)) {
                continue;
            }
            const double measure = source == 0 || source == sources - 1 ? 0.5 : 1.0;
            if (weights.empty()) {
                first = source;
            }
            weights.push_back(measure * terms.weights[static_cast<std::size_t>(term)]);
            sum += weights.back();
        }
        for (double& weight : weights) {
            weight /= sum;
        }
        map.append(first, weights);
    }
    return map;
}

std::size_t LineMap::bytes() const {
    return first_.size() * sizeof(int) + begin_.size() * sizeof(std::size_t) +
           weights_.size() * sizeof(double);
}

} // namespace millwright::grid
