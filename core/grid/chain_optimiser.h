// The whole chain that cuts the error, each link by its own method: which tracks (dynamic programming over
// candidates), the best nodes on each (shortest path on a lattice, then a polish), then all nodes at once,
// tracks bending, downhill in the error with exponents that rise from the mean to the worst move, and by
// leaps where a descent stands still.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/path_descent.h"
#include "core/grid/track_candidates.h"
#include "core/grid/track_optimiser.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::grid {

/// Values outside their range throw Defect when the optimiser is made.
struct ChainSettings {
    TrackSettings tracks{.tip_share = 1.0, .param_share = 0.0, .length_share = 1.0, .polish_sweeps = 15};
    int candidates_per_gap = 8;  ///< places that a track may take between two of the start's, 1 to 64
    double narrowest_gap = 0.75; ///< of chosen tracks, in gaps of the start, 0.1 to 1
    double widest_gap = 1.125;   ///< the same, 1 to 2
    int first_descent = 300;     ///< iterations at the exponent of `tracks`, at most, 0 to 100 000
    int later_descents = 150;    ///< the same at each later exponent
    int leaps = 2;               ///< of a descent that stands still before that, 0 to 100 (PathDescent::leap)
    /// Of the error, one descent each. Without the 6 the two bells at 40 nodes end at a largest error of
    /// 0.178 instead of 0.148 mm, the dome at 10 at a mean of 0.643 instead of 0.640 mm.
    std::vector<double> exponents{4.0, 6.0, 8.0, 16.0, 32.0};
    double least_jacobian = 0.015; ///< of a corner triangle in a grid that is accepted, 1 on a uniform grid
};

/// First step: measures the start. Second: the tracks and their nodes, beside what the track optimiser makes
/// of the start's own; where they break the promise they are chosen anew with a price on the tool axis. Then
/// a few iterations of a descent a step. `best` has the least product of max and mean of the grids that keep
/// the promise: max, mean, lmean and axis_max not above the start's, the track gap not above it by more than
/// the allowance, no corner triangle below the least. In the end it is the best of a link whose path as it is
/// run keeps the promise of QualityGuard too. `norm` is the furthest way of a node in the last iteration, in
/// cells.
class ChainOptimiser final : public GridOptimiser {
public:
    /// `model` must outlive the optimiser. Throws Defect if a track of `start` is not straight.
    ChainOptimiser(const ErrorModel& model,
                   const Grid& start,
                   TrackDirection direction,
                   ChainSettings settings);

    bool advance(const Progress& progress) override;
    [[nodiscard]] const OptimiserState& state() const override { return state_; }

private:
    enum class Stage { start, tracks, descent, leap, done };
    struct Best {
        Grid grid;
        ErrorSummary reached;
    };

    void measure_start(const Progress& progress);
    void choose_tracks(const Progress& progress);
    void optimise_tracks(const Progress& progress);
    bool choose_by_cost(const std::string& name, const TrackCandidates& candidates, const Progress& progress);
    bool choose_with_axis_priced(const Progress& progress);
    bool take(const std::string& name,
              const TrackCandidates& candidates,
              int nearest,
              int furthest,
              const Progress& progress);
    [[nodiscard]] TrackSettings price_axis(double price) const;
    void begin_descent(const Progress& progress);
    void descend(const Progress& progress);
    void leap(const Progress& progress);
    void end_descent(const Progress& progress);
    [[nodiscard]] int iterations_allowed() const;
    [[nodiscard]] double exponent() const;
    [[nodiscard]] std::string fault_of(const Grid& grid) const;
    std::string consider(const NodeArray& nodes, const Progress& progress);
    void end_link(std::string name, std::string refused);
    void finish(const Progress& progress);
    [[nodiscard]] double done_of_all(int of_level) const;

    const ErrorModel& model_;
    TrackDirection direction_;
    ChainSettings settings_;
    Stage stage_ = Stage::start;
    OptimiserState state_;
    std::vector<PlacedTrack> start_;
    double widest_gap_mm_ = 0.0;
    double moving_price_ = 0.0; // of the axis, while all nodes move
    std::optional<PathDescent> descent_;
    std::size_t level_ = 0; // 0: the exponent of the tracks; n: exponents[n - 1]
    int iterations_of_level_ = 0;
    int leaps_of_level_ = 0;
    std::string refused_;     // why the nodes that were looked at last are not taken
    NodeArray accepted_;      // where the next descent begins
    std::vector<Best> bests_; // after each link, if it was better than that before
};

} // namespace millwright::grid
