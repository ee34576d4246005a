// One point that the tool touches, before a tool leans there or a machine has its say.
#pragma once

#include "core/geometry/outline_tree.h"
#include "core/geometry/parametric_surface.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// At the parameters `uv`, along the normal on the side of the tool. Throws Error where there is none.
[[nodiscard]] PathPoint contact_point(const geometry::ParametricSurface& patch, const Vec2& uv, bool flipped);

/// `uv`, or, where the surface has no normal there and it is outside of `outline` (null: everything is cut),
/// a place close beside it that has one, for those who measure beyond what is cut. `uv` where there is none.
[[nodiscard]] Vec2 place_with_normal(const geometry::ParametricSurface& patch,
                                     const geometry::OutlineTree* outline,
                                     const Vec2& uv);

} // namespace millwright::toolpath
