// The simplest method that follows a machine: along each track, on its own, nodes with equal shares of a
// monitor of the error (equidistribution, de Boor 1973). No search: it misses what a singular point does
// between two nodes, and is what the better methods are compared with.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/quality_guard.h"

namespace millwright::grid {

struct RedistributionSettings {
    double floor = 0.1; ///< of the monitor, in its means, above 0: no part of a track is left without nodes
    int smoothings = 1; ///< binomial passes over the monitor
    double gap_allowance = 0.15; ///< as in TrackSettings

    friend bool operator==(const RedistributionSettings&, const RedistributionSettings&) = default;
};

/// sqrt(e) / h of moves about half as long as a mean step of `nodes` per track, h their length in the
/// parameter, at the middles of `cells` equal cells between `first` and `last`: what a move of the grid will
/// see, which moves that are much shorter do not. Out of reach counts as none. Scaled to mean 1; all 1 where
/// there is no error. Throws Cancelled.
[[nodiscard]] std::vector<double>
step_monitor(const ErrorModel& model, const PlacedTrack& track, int cells, const Progress& progress);

/// One step. `best` keeps the promise of never_worse().
class Redistribution final : public GridOptimiser {
public:
    /// `model` must outlive this. Throws Defect if a track of `start` is not straight, or a setting has no
    /// sense.
    Redistribution(const ErrorModel& model,
                   const Grid& start,
                   TrackDirection direction,
                   const RedistributionSettings& settings = {});

    bool advance(const Progress& progress) override;
    [[nodiscard]] const OptimiserState& state() const override { return state_; }

private:
    const ErrorModel& model_;
    RedistributionSettings settings_;
    OptimiserState state_;
    std::vector<PlacedTrack> start_;
};

} // namespace millwright::grid
