// A weight that a person types: a formula of u, v (0 to 1) or of the solver coordinates x, y.
#pragma once

#include "core/grid/weight.h"

#include <string>

namespace millwright::grid {

/// The weight `text` on a grid of nu x nv nodes; operators and functions as muParser has them (+ - * / ^ sin
/// exp abs sqrt ... ? :), pi, and the variables u, v, x = u (nu - 1), y = v (nv - 1). Throws Error with the
/// column if `text` is no formula, or if it has no finite value at a node of the uniform grid; values()
/// throws Error with the place on the grid where it has none. Gradients are central differences.
[[nodiscard]] WeightPtr expression_weight(const std::string& text, int nu, int nv);

} // namespace millwright::grid
