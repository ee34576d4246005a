// The method that cuts the error: the nodes of each track, on their own, where the machine wants them. First
// the best path through a fine lattice by dynamic programming, which is the optimum on that lattice, then a
// polish between its places. Tracks stay straight and where they are: cells cannot fold, and the scallop
// height hardly changes.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/polish.h"
#include "core/grid/track_path.h"
#include "core/grid/track_quality_guard.h"
#include "core/grid/track_settings.h"

#include <vector>

namespace millwright::grid {

/// First step: measures the start and the moves of the lattices. Second: the best paths. Then one polishing
/// sweep a step. The figures of `state` are there after the first step; while polishing `now` is by the
/// polish's sampling, all else fine. `best` is above `start` neither in axis_max nor in max, mean and lmean,
/// and its track gap is not above the start's by more than the allowance. `norm` is the longest way of a node
/// in the last sweep, in mean steps of a track.
class TrackOptimiser final : public GridOptimiser {
public:
    /// `model` must outlive the optimiser. Throws Defect if a track of `start` is not straight
    /// (straight_tracks).
    TrackOptimiser(const ErrorModel& model,
                   const Grid& start,
                   TrackDirection direction,
                   const TrackSettings& settings);

    bool advance(const Progress& progress) override;
    [[nodiscard]] const OptimiserState& state() const override { return state_; }

private:
    enum class Stage { lattices, paths, polish, done };

    void measure_lattices(const Progress& progress);
    void find_paths(const Progress& progress);
    void sweep(const Progress& progress);
    void begin_polish();
    void
    end_polish(const std::vector<TrackPolish>& polished, OptimiserStatus status, const Progress& progress);
    void finish(OptimiserStatus status);
    void publish(const GuardedTracks& best);

    [[nodiscard]] std::vector<MoveLimits> aims(const Progress& progress) const;
    [[nodiscard]] PlacedTrack path_of(std::size_t track, const MoveLimits& limits) const;
    [[nodiscard]] MoveCost cost_of(std::size_t track) const;
    [[nodiscard]] int moves() const { return static_cast<int>(std::ssize(start_.front().places)) - 1; }

    const ErrorModel& model_;
    TrackSettings settings_;
    Stage stage_ = Stage::lattices;
    OptimiserState state_;
    std::vector<PlacedTrack> start_;
    std::vector<MeasuredTrack> measured_start_;
    TrackQualityLimits quality_limits_;
    std::vector<MoveTable> tables_;
    std::vector<MoveLimits> limits_; // [track], by the search's sampling
    std::vector<MeasuredTrack> paths_;
    std::vector<TrackPolish> polishes_;
};

} // namespace millwright::grid
