// The other question: not the least error of so many points, but the fewest points for an error.
#pragma once

#include "core/base/progress.h"
#include "core/plan/plan.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::studies {

/// Straight tracks along u on one surface and machine, evenly over v = 0.02 ... 0.98.
struct FewestPointsCase {
    std::string surface = "two-bell"; ///< id of a preset
    std::string machine = "ac-table"; ///< id of a shipped machine
    int tracks = 8;                   ///< 1 to 1000
};

struct FewestPointsRow {
    double tolerance = 0.0; ///< largest distance of the true tip from the surface curve, mm
    std::optional<int>
        uniform; ///< with equal steps on each track; nothing where `most_uniform` per track are too few
    std::optional<int> fewest; ///< by grid::fewest_nodes; nothing where its lattice is too coarse
    double largest = 0.0;      ///< of the moves between the fewest, mm
    double largest_axis = 0.0; ///< of the tool axis to the surface normal on them, rad
};

/// Nodes per track at which equal steps are given up.
inline constexpr int most_uniform = 4000;

/// The points of all tracks together, a row a tolerance (mm, above 0). Parallel over tracks; the same bytes
/// on any number of threads. Throws Error if surface or machine are unknown, Cancelled.
[[nodiscard]] std::vector<FewestPointsRow> fewest_points(const FewestPointsCase& of,
                                                         std::span<const double> tolerances,
                                                         const plan::Folders& folders,
                                                         const Progress& progress);

/// Comma-separated, one line per row.
[[nodiscard]] std::string fewest_points_csv(const FewestPointsCase& of,
                                            std::span<const FewestPointsRow> rows);

} // namespace millwright::studies
