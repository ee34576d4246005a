// Places where a track may lie, each with the best nodes there, and the choice of tracks among them.
#pragma once

#include "core/grid/track_optimiser.h"

#include <optional>
#include <span>
#include <vector>

namespace millwright::grid {

// Where the tracks themselves should lie: of many candidates between the outer two, those whose best nodes
// cost least together, at distances that keep the scallop height.

/// The `count` of costs.size() candidates, ascending, with the least sum of costs: the first and the last are
/// among them, and neighbours are `nearest` to `furthest` candidates apart. By dynamic programming, exact.
/// Nothing if there is no such choice of finite cost. Throws Defect unless count >= 2 and
/// 1 <= nearest <= furthest.
[[nodiscard]] std::optional<std::vector<int>>
cheapest_choice(std::span<const double> costs, int count, int nearest, int furthest);

/// Candidates lie evenly between neighbours of a start's tracks, which are among them.
class TrackCandidates {
public:
    /// The best nodes of each on its lattice, by the cost of `settings` (checked), in parallel; the nodes
    /// between the start's where no path is in reach. `model` must outlive this. Throws Cancelled.
    TrackCandidates(const ErrorModel& model,
                    const std::vector<PlacedTrack>& start,
                    int candidates_per_gap,
                    const TrackSettings& settings,
                    const Progress& progress);

    /// As many tracks as the start has, `nearest` to `furthest` candidates apart, whose costs are least in
    /// sum, each polished; nothing if no choice is of finite cost. Throws Cancelled.
    [[nodiscard]] std::optional<std::vector<PlacedTrack>>
    cheapest(int nearest, int furthest, const Progress& progress) const;

private:
    const ErrorModel& model_;
    TrackSettings settings_;
    int tracks_;
    std::vector<PlacedTrack> placed_;
    std::vector<double> costs_;
};

} // namespace millwright::grid
