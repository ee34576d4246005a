// Where a patch is and which way it lies there, without its second derivatives: for searches that ask nothing
// else, a hundred million times.
#pragma once

#include "core/geometry/bezier_patch.h"

#include <optional>

namespace millwright::geometry {

struct SurfaceTangents {
    Vec3 position = Vec3::Zero();
    Vec3 du = Vec3::Zero();
    Vec3 dv = Vec3::Zero();
};

/// The same bits as those of patch.derivatives(u, v).
[[nodiscard]] SurfaceTangents tangents(const BezierPatch& patch, double u, double v);

/// The same bits as patch.unit_normal(u, v).
[[nodiscard]] std::optional<Vec3> unit_normal(const BezierPatch& patch, const SurfaceTangents& at);

} // namespace millwright::geometry
