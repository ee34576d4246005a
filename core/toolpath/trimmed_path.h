// The part of a path that lies inside a trimmed patch: tracks end and begin at the outline, and what is
// between is gone over lifted.
#pragma once

#include "core/geometry/outline_tree.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/trim.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// What is touched at `uv`, along the normal on the side of the tool, for a path that is still to be trimmed.
/// Outside of `outline` (null: everything is cut) the surface needs no normal: the point has none, 0. Throws
/// Error where there is none else.
[[nodiscard]] PathPoint point_to_trim(const geometry::ParametricSurface& patch,
                                      const geometry::OutlineTree* outline,
                                      const Vec2& uv,
                                      bool flipped);

/// `contacts` as a strategy gives it, before the tool. Points are added where tracks cross the outline. A
/// link stays one (`MoveKind::cross`) only between two ends of tracks that are kept and where its straight
/// way in the parameters stays inside; else it goes `over`. Throws Error if nothing is left, and where the
/// surface has no normal at the outline. Points without a normal that stay, on the outline itself, get it.
[[nodiscard]] Toolpath trimmed(const geometry::ParametricSurface& patch,
                               const geometry::Trim& trim,
                               Toolpath contacts,
                               bool flipped);

} // namespace millwright::toolpath
