// The fine lattice of a track: the places that its nodes are chosen from. Denser where the error of short
// moves is large: half of its density is uniform, half follows the monitor sqrt(e / h^2), to which the best
// spacing of nodes is proportional away from the machine's singular points.
#pragma once

#include "core/base/progress.h"
#include "core/grid/error_model.h"
#include "core/grid/track.h"

#include <span>
#include <vector>

namespace millwright::grid {

struct LatticeSettings {
    int intervals = 160;        ///< of the lattice
    double monitor_share = 0.5; ///< of the density that follows the monitor, 0 to 0.99
    int smoothings = 3;         ///< binomial passes over the monitor
};

/// sqrt(e / h^2) of `cells` equal short moves between `first` and `last`, smoothed, scaled to mean 1.
/// All 1 where there is no error at all; moves out of reach count as none.
[[nodiscard]] std::vector<double> monitor(const ErrorModel& model,
                                          const Track& track,
                                          double first,
                                          double last,
                                          int cells,
                                          int smoothings,
                                          const Progress& progress);

/// `intervals` + 1 places from `first` to `last` with equal shares of `density`, which is constant on equal
/// cells. Both ends exact. Throws Defect unless the density is positive.
[[nodiscard]] std::vector<double>
equal_shares(std::span<const double> density, double first, double last, int intervals);

/// `places`, ascending, with the nearest place of each of `nodes` moved onto it, or a place added where two
/// nodes have the same nearest one.
[[nodiscard]] std::vector<double> through(std::vector<double> places, std::span<const double> nodes);

/// The lattice of `start`'s track. Every node of `start` is in it, so that the best path on the lattice is
/// never worse than the start. Throws Cancelled.
[[nodiscard]] std::vector<double> lattice(const ErrorModel& model,
                                          const PlacedTrack& start,
                                          const LatticeSettings& settings,
                                          const Progress& progress);

} // namespace millwright::grid
