// The weight w of the volume term: where it is large, cells become small (the area of a cell goes like
// w^(-1/2), since w J^2 is what the Euler equations even out). Points are in solver coordinates, where the
// spacing of a uniform grid is 1: x = u (nu - 1), y = v (nv - 1). W1 ... W5 are those of (Parasilmongkol
// 1997, KMITL), ch. 4.
#pragma once

#include "core/grid/node_array.h"

#include <memory>
#include <span>
#include <vector>

namespace millwright::grid {

/// Const and callable from several threads.
class Weight {
public:
    virtual ~Weight() = default;

    /// w at each point. Throws Error where a weight that a person typed has no finite value.
    virtual void values(std::span<const Vec2> at, std::span<double> w) const = 0;

    /// (dw/dx, dw/dy) at each point.
    virtual void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const = 0;
};

using WeightPtr = std::shared_ptr<const Weight>;

/// The same everywhere: no adaptation.
[[nodiscard]] WeightPtr constant_weight(double value);

/// exp(-|r^2 - (x - cx)^2 - (y - cy)^2|) + 0.01, large on a circle.
struct Ring {
    Vec2 centre{10.0, 10.0};
    double radius_squared = 25.0;
};
[[nodiscard]] WeightPtr ring_weight(const Ring& ring);

/// Circle of radius 5 about (10, 10).
[[nodiscard]] WeightPtr weight_w1();
/// W1 stretched over side x side nodes: as wide there as on 25 x 25.
[[nodiscard]] WeightPtr weight_w1_on(int side);
/// Circle of radius sqrt(rows) about (10, 10).
[[nodiscard]] WeightPtr weight_w2(int rows);
/// Quarter circle of radius 5 about (rows, columns).
[[nodiscard]] WeightPtr weight_w3(int rows, int columns);
/// sin(2 pi x / 25) sin(2 pi y / 25) / 1000. Changes its sign, so the functional has no lower bound.
[[nodiscard]] WeightPtr weight_w4();
/// exp((x^2 + y^2) / scale^2). With scale 1 it is beyond the range of numbers from 27 nodes on.
[[nodiscard]] WeightPtr weight_w5(double scale);

/// w at every node, row by row. Parallel.
[[nodiscard]] std::vector<double> weight_at_nodes(const Weight& weight, const NodeArray& nodes);

/// How many nodes have a weight that is not positive. If any, the functional may have no minimum: warn.
[[nodiscard]] int count_not_positive(const Weight& weight, const NodeArray& nodes);

} // namespace millwright::grid
