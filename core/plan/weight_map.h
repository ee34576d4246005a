// The weight w of the elliptic functional over the whole surface, for people to look at: what pulls the nodes
// before anything has moved. No unit.
#pragma once

#include "core/base/progress.h"
#include "core/plan/evaluation.h"
#include "core/project/project.h"

#include <vector>

namespace millwright::plan {

/// On a raster at u = i / (rows - 1), v = j / (columns - 1).
struct WeightMap {
    int rows = 0;
    int columns = 0;
    std::vector<double> values; ///< [rows x columns], row = u; finite
    double low = 0.0;           ///< the least of them
    double high = 0.0;          ///< the largest of them

    [[nodiscard]] double at(int i, int j) const {
        return values[static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(j)];
    }
};

/// The weight as the elliptic adaptation begins with it: where it comes from the error, that is the error
/// density of the uniform grid. A formula that has no finite value somewhere between the nodes is shown at
/// the nodes alone. Throws Error if it has none at a node, or no sense; Cancelled.
[[nodiscard]] WeightMap
weight_map(const project::GridInput& input, const CuttingSetup& cutting_setup, const Progress& progress);

} // namespace millwright::plan
