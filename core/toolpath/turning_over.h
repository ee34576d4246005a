// Where a surface turns over along a path: its normal flips to the other side, so that a tool that cuts from
// one side would have to come from below.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/trim.h"
#include "core/grid/grid.h"
#include "core/toolpath/toolpath.h"

#include <optional>

namespace millwright::toolpath {

/// A place of the straight way from `a` to `b` in the parameters at which the normal goes from one direction
/// to one more than a right angle away without those between; nothing where it turns by and by, however fast
/// the surface bends. Found by halving the way: what flips and flips back is missed.
[[nodiscard]] std::optional<Vec2>
flip_between(const geometry::ParametricSurface& patch, const Vec2& a, const Vec2& b);

/// Throws Error, naming the place, where the normal flips inside `trim`: between points of `contacts` that
/// follow each other, and between neighbouring nodes of the grid. What is never cut does not matter: nor does
/// it that pieces on both sides of a hole face opposite ways, since no cut leads from one to the other.
void refuse_turning_over(const geometry::ParametricSurface& patch,
                         const geometry::Trim& trim,
                         const grid::Grid& grid,
                         const Toolpath& contacts);

} // namespace millwright::toolpath
