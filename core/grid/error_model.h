// What the grid room wants to know of a machine, and no more: how wrong is a move between two parameters?
// Implemented by core/toolpath for real machines, and by tests with closed forms.
#pragma once

#include "core/base/progress.h"
#include "core/grid/grid.h"

#include <memory>
#include <span>
#include <vector>

namespace millwright::grid {

/// One straight move in axis coordinates between two nodes of a track.
struct MoveError {
    double tip = 0.0;    ///< largest distance of the true tip from the surface curve between the nodes, mm
    double axis = 0.0;   ///< largest angle of the true tool axis to the surface normal, rad
    double length = 0.0; ///< length of the surface curve between the nodes, mm
    /// What of `tip` leaves the surface (gouge or excess), largest, mm. The rest goes along the surface,
    /// across the track: it moves the cut but not the surface. 0 from a model that cannot tell.
    double off_surface = 0.0;
    /// Largest distance from the surface point at the same fraction of the parameters, mm: also counts a tip
    /// that is on the curve, but early or late. 0 from a model that cannot tell.
    double param = 0.0;
};

/// How finely a move is sampled. The search uses `coarse`, final figures `fine`.
struct Sampling {
    int tip = 10;   ///< times inside the move at which the true pose is taken
    int curve = 16; ///< chords of the surface curve that the tip is compared with

    friend bool operator==(const Sampling&, const Sampling&) = default;
};
inline constexpr Sampling coarse{10, 16};
inline constexpr Sampling fine{40, 200};

/// The moves between any two of a list of nodes on one track, with all that depends on one node computed
/// once.
class LatticeErrors {
public:
    virtual ~LatticeErrors() = default;
    /// The move from node k to node l > k. May be called from several threads.
    [[nodiscard]] virtual MoveError between(int k, int l) const = 0;
};

/// The figures that are always shown together. Lengths mm, angles rad.
struct ErrorSummary {
    double max = 0.0;
    double mean = 0.0;  ///< per move
    double lmean = 0.0; ///< weighted by the length of the moves
    double rms = 0.0;
    double p95 = 0.0;      ///< 95 % of the moves are not worse (nearest rank)
    double variance = 0.0; ///< per move
    double axis_max = 0.0;
    double axis_mean = 0.0;
};

/// Infinity in every figure.
[[nodiscard]] ErrorSummary out_of_reach();

/// The error of moves on one surface and machine. Const and callable from several threads.
class ErrorModel {
public:
    virtual ~ErrorModel() = default;

    /// The move from `a` to `b` (straight in the parameters), rotary branch of `b` nearest to that of `a`.
    /// Out of reach gives infinity in `tip` and `axis`.
    [[nodiscard]] virtual MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const = 0;

    /// Moves among `nodes`, which lie in order on one track.
    [[nodiscard]] virtual std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                                 Sampling sampling) const = 0;

    /// The largest distance between neighbouring tracks, mm on the surface (decides the scallop height).
    [[nodiscard]] virtual double track_gap(const Grid& grid, TrackDirection direction) const = 0;

    /// The figures of the whole path over `grid`, whose branches continue from move to move: what people are
    /// shown, and the last word on a grid. Infinity where the path cannot be run. By default every move for
    /// itself, finely.
    [[nodiscard]] virtual ErrorSummary
    on_path(const Grid& grid, TrackDirection direction, const Progress& progress) const;
};

/// All moves inside tracks, [tracks x (nodes - 1)], track by track. Parallel over tracks. Throws Cancelled
/// through `progress`.
[[nodiscard]] std::vector<MoveError> measure(const ErrorModel& model,
                                             const Grid& grid,
                                             TrackDirection direction,
                                             Sampling sampling,
                                             const Progress& progress = Progress());

/// Throws Defect if `moves` is empty. Infinity in, infinity out.
[[nodiscard]] ErrorSummary summary(std::span<const MoveError> moves);

} // namespace millwright::grid
