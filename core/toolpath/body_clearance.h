// How near a body of revolution comes to the surface: the error of a cut that is made by a cutter and not by
// a point.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/toolpath/profile.h"

namespace millwright::toolpath {

struct BodyClearance {
    Vec2 parameters = Vec2::Zero(); ///< of the surface point, inside [0,1]^2
    double distance = 0.0;          ///< mm; negative: so deep below this point the body ends
};

/// Descends from `start` to the surface point that is locally nearest to the body, or deepest in it: a damped
/// Newton iteration that stays inside [0,1]^2. Throws Defect if the pose is not finite.
[[nodiscard]] BodyClearance clearance_near(const geometry::ParametricSurface& patch,
                                           const Profile& body,
                                           const geometry::ToolPose& pose,
                                           const Vec2& start);

} // namespace millwright::toolpath
