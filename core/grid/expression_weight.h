// A weight that a person types: a formula of the place on the surface, its shape there and the error.
#pragma once

#include "core/base/error.h"
#include "core/geometry/parametric_surface.h"
#include "core/grid/weight.h"

#include <memory>
#include <optional>
#include <string>

namespace millwright::grid {

/// What a formula may speak of beside the parameters. Null: not at hand.
struct FormulaGround {
    std::shared_ptr<const geometry::ParametricSurface> patch; ///< x, y, z, nx, ny, nz, k1, k2
    WeightPtr error;                                          ///< err
};

/// The weight `text` on a grid of nu x nv nodes; operators and functions as muParser has them (+ - * / ^ sin
/// exp abs sqrt ... ? :), pi, and the variables
///   u, v        parameters, 0 to 1;  i = u (nu - 1), j = v (nv - 1)
///   x, y, z     the point of the surface, mm;  nx, ny, nz  its unit normal, S_u x S_v
///   k1, k2      principal curvatures, 1/mm, k1 >= k2, positive towards the normal
///   err         the error there, mm, of a move as long as a cell of the uniform grid
/// Throws Error with the column if `text` is no formula or speaks of what is not at hand, or if it has no
/// finite value at a node of the uniform grid; values() throws Error with the place on the grid where it has
/// none. Gradients are central differences.
[[nodiscard]] WeightPtr
expression_weight(const std::string& text, int nu, int nv, const FormulaGround& ground = {});

/// What is wrong with `text` as a formula of these variables, whatever their values, with its column.
[[nodiscard]] std::optional<Diagnostic> fault_of_expression(const std::string& text);

/// Whether a formula without faults speaks of the error, which changes from round to round.
[[nodiscard]] bool speaks_of_error(const std::string& text);

} // namespace millwright::grid
