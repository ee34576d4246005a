// One level of a multigrid method: an array of nodes, the right side that its equations have there, and the
// weight. On the finest level the weight is asked anew where the nodes have gone. On the others it is what
// was restricted to them, since a narrow ridge that no coarse node sees must act there too, and changes with
// its slope as the nodes move: without the slope a strong weight keeps the cycles from converging.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/internal/node_step.h"

#include <vector>

namespace millwright::grid {

/// What is solved on every level.
struct LevelRules {
    FunctionalWeights functional;
    Boundary boundary = Boundary::fixed;
};

class MultigridLevel {
public:
    /// At least 3 x 3 nodes. `weight` is null on coarse levels.
    MultigridLevel(
        int rows, int columns, const IndexDensity& density, const LevelRules& rules, WeightPtr weight);

    [[nodiscard]] int rows() const { return nodes.rows; }
    [[nodiscard]] int columns() const { return nodes.columns; }
    [[nodiscard]] const IndexDensity& density() const { return density_; }

    /// On a coarse level, whose nodes and w have just been set: they are what the weight slopes from.
    void begin();

    /// The weight where the nodes are. False if it is not finite somewhere. Throws Error if the weight does.
    bool ask_weight();

    /// One Gauss-Seidel sweep in four colours, each node going to its own solution. The nodes of a colour do
    /// not know each other, so that the bytes are the same on any number of threads. False if the weight is
    /// not finite; nothing has moved then.
    bool smooth();

    /// right_side - R with zeros where a node may not go, at the weight that was asked last. Parallel.
    void residual(NodeArray& found) const;

    /// No corner of a cell is folded or empty. Parallel.
    [[nodiscard]] bool sound() const;

    NodeArray nodes;
    std::vector<double> w;
    NodeArray right_side; ///< empty: zero

private:
    [[nodiscard]] bool moves(int i, int j) const;
    [[nodiscard]] NodeStencil stencil(int i, int j) const;
    [[nodiscard]] NodeEquations equations(int i, int j) const;
    void smooth_node(int i, int j);

    IndexDensity density_;
    LevelRules rules_;
    WeightPtr weight_;
    NodeArray begun_;             ///< coarse: where the nodes were at begin()
    std::vector<double> w_begun_; ///< ... their weight
    std::vector<Vec2> slope_;     ///< ... and its slope
};

} // namespace millwright::grid
