// Where a patch is and which way it faces there, and no more: for searches that ask nothing else, a hundred
// million times.
#pragma once

#include "core/geometry/bezier_patch.h"

#include <optional>

namespace millwright::geometry {

struct SurfacePoint {
    Vec3 position = Vec3::Zero();
    std::optional<Vec3> normal; ///< unit; nothing where the tangents vanish or are parallel
};

/// The same bits as patch.derivatives(u, v).position and patch.unit_normal(u, v).
[[nodiscard]] SurfacePoint point_of(const BezierPatch& patch, double u, double v);

} // namespace millwright::geometry
