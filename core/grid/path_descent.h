// Descends in a PathObjective by L-BFGS. No step folds a cell or leaves the machine's reach, since the
// objective is infinite there. Where it stands still it can look beyond the ridges around it.
#pragma once

#include "core/base/progress.h"
#include "core/grid/descent.h"
#include "core/grid/error_model.h"
#include "core/grid/track_path.h"

#include <limits>
#include <vector>

namespace millwright::grid {

// What all nodes of a grid cost together, as a function of where they lie: the errors of the moves along the
// tracks, a barrier against folded cells (after Ivanenko 1993), and a penalty on tracks that drift apart or
// together. Bending tracks cuts the error further than any choice of nodes on straight ones.

struct PathObjectiveSettings {
    MoveCost cost = {};
    double unit_cost = 1.0;       ///< cost of a move that counts as one
    double corner_weight = 1e-3;  ///< of (|x_xi|^2 + |x_eta|^2) / (J - least_jacobian), each corner triangle
    double least_jacobian = 0.02; ///< 1 is that of a uniform grid
    double widest_gap = 1.125;    ///< of neighbouring nodes across the tracks, in mean gaps; free up to here
    double narrowest_gap = 0.5;   ///< the same
    double gap_softness = 0.1;    ///< mean gaps beyond, that cost one
    Sampling sampling = coarse;
};

struct PathCost {
    double sum = 0.0;
    std::vector<double> moves; ///< a node: of the move that begins there; 0 of a track's last
};

/// Lengths are in cells of the uniform grid with the same outline. The corners stay, nodes of the outline
/// slide along it. Const and deterministic: the same bytes on any number of threads.
class PathObjective {
public:
    /// `model` must outlive this. `outline` is an array whose outline is a rectangle along the axes; throws
    /// Defect if it is not.
    PathObjective(const ErrorModel& model,
                  TrackDirection direction,
                  const NodeArray& outline,
                  const PathObjectiveSettings& settings);

    /// Infinity where a corner triangle is too small or a move is out of reach. Throws Cancelled.
    [[nodiscard]] double value(const NodeArray& nodes, const Progress& progress) const;

    /// value(), and what it is made of.
    [[nodiscard]] PathCost cost(const NodeArray& nodes, const Progress& progress) const;

    /// d value / d node by one-sided differences, a cell; zero along what may not move. Throws
    /// Cancelled, and Defect where value() is not finite.
    [[nodiscard]] std::vector<Vec2> gradient(const NodeArray& nodes, const Progress& progress) const;
    /// The same where the `cost` of `nodes` is at hand.
    [[nodiscard]] std::vector<Vec2>
    gradient(const NodeArray& nodes, const PathCost& cost, const Progress& progress) const;

    /// What depends on nodes `k` and `k + 1` of a track alone, were they at `from` and `to` and all others of
    /// the other tracks as in `nodes`: the move, and the corners of the cells on both its sides. Infinity as
    /// in value(), and where the corners alone cost `most` or more.
    [[nodiscard]] double of_move(const NodeArray& nodes,
                                 int track,
                                 int k,
                                 const Vec2& from,
                                 const Vec2& to,
                                 double most = std::numeric_limits<double>::infinity()) const;

    /// The gaps from node `k` of a track, were it at `place`, to its neighbours across.
    [[nodiscard]] double of_gaps(const NodeArray& nodes, int track, int k, const Vec2& place) const;

    /// `nodes`, each gone `factor` times its step, given in cells; none leaves the unit square.
    [[nodiscard]] NodeArray
    moved(const NodeArray& nodes, double factor, const std::vector<Vec2>& steps) const;

    [[nodiscard]] TrackDirection direction() const { return direction_; }
    [[nodiscard]] const Vec2& cell() const { return cell_; } ///< of the uniform grid

private:
    class Around;

    [[nodiscard]] double move_cost(const Vec2& from, const Vec2& to) const;
    [[nodiscard]] double gap_cost(const Vec2& from, const Vec2& to) const;
    template <class Nodes> [[nodiscard]] double corners_of_cell(const Nodes& nodes, int i, int j) const;
    template <class Nodes, class Cost>
    [[nodiscard]] double at_node(const Nodes& nodes, int i, int j, const Cost& cost) const;
    [[nodiscard]] double slope(const NodeArray& nodes, int i, int j, int coordinate, double now) const;

    const ErrorModel* model_;
    TrackDirection direction_;
    int rows_;
    int columns_;
    Vec2 cell_; // of the uniform grid
    PathObjectiveSettings settings_;
};

class PathDescent {
public:
    /// Throws Defect if the objective is infinite at `start`. Throws Cancelled.
    PathDescent(PathObjective objective, NodeArray start, const Progress& progress);

    /// One step downhill; false if there is none. Throws Cancelled, leaving all as it was.
    bool iterate(const Progress& progress);

    /// Takes the best places of whole tracks together (shortest_curved_tracks), coarsely and then finer;
    /// false, and all stays, if that gains next to nothing. Throws Cancelled, leaving all as it was.
    bool leap(const Progress& progress);

    [[nodiscard]] const NodeArray& nodes() const { return nodes_; }
    [[nodiscard]] double value() const { return value_; }
    /// Of the last step, the way of the node that went furthest, in cells.
    [[nodiscard]] double last_step() const { return last_step_; }

private:
    bool search(const std::vector<Vec2>& direction, const Progress& progress);

    PathObjective objective_;
    NodeArray nodes_;
    double value_;
    std::vector<Vec2> gradient_;
    DescentMemory memory_;
    double last_step_ = 0.0;
};

} // namespace millwright::grid
