// The point of a patch that lies farthest in a direction: where the box of the patch itself ends, which that
// of its control points only holds.
#pragma once

#include "core/geometry/bezier_patch.h"

namespace millwright::geometry {

struct FarthestPoint {
    Vec2 parameters = Vec2::Zero(); ///< in [0,1]^2
    double along = 0.0;             ///< position . direction
};

/// To within a thousand-millionth of the extent of the control points in that direction.
[[nodiscard]] FarthestPoint farthest_point(const BezierPatch& patch, const Vec3& direction);

} // namespace millwright::geometry
