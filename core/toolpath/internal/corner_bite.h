// How deep the corner of a body of revolution, or its sharp edge, is below a surface: of a body that bites
// with its rim no point of the surface tells it.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/toolpath/profile.h"

namespace millwright::toolpath {

struct CornerBite {
    Vec2 parameters = Vec2::Zero(); ///< of the surface point above it
    double height = 0.0;            ///< mm, of the corner's lowest point over the surface; negative: below
};

/// Of a body with a flat bottom the deepest point of the corner around it, on the side of the bottom that
/// leans below the surface at `start`: the ring of the arc's centres runs on a circle, each of whose points
/// is as far from the surface as its closest point says, which is looked for from `start`. What is beyond an
/// edge of the patch is below nothing. The surface's side is that of the tool axis.
[[nodiscard]] CornerBite corner_bite(const geometry::ParametricSurface& patch,
                                     const Profile& body,
                                     const geometry::ToolPose& pose,
                                     const Vec2& start);

} // namespace millwright::toolpath
