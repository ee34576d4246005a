// Descends in a PathObjective by L-BFGS. No step folds a cell or leaves the machine's reach, since the
// objective is infinite there. Where it stands still it can look beyond the ridges around it.
#pragma once

#include "core/grid/descent.h"
#include "core/grid/path_objective.h"

namespace millwright::grid {

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
