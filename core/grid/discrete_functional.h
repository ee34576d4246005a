// The grid functional I_s + 2 LV I_v + LO I_o on the grid itself instead of its Euler equations: a quarter of
// the sum over the four corner triangles of every cell (after Ivanenko 1993). Its smoothness term grows
// without bound as a triangle closes, so that a descent which starts without a fold never makes one.
#pragma once

#include "core/grid/elliptic_equations.h"
#include "core/grid/node_array.h"
#include "core/grid/weight.h"

namespace millwright::grid {

struct DiscreteFunctional {
    double value = 0.0; ///< infinity if a corner triangle is not positive or the weight is not finite
    NodeArray gradient; ///< d value / d node, about -2 (R_X, R_Y) inside; empty if the value is infinite
};

/// Parallel over rows, same bytes on any number of threads. Throws Error if the weight does.
[[nodiscard]] DiscreteFunctional
discrete_functional(const NodeArray& nodes, const Weight& weight, const FunctionalWeights& lambda);

} // namespace millwright::grid
