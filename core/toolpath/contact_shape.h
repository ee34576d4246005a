// The cutter's shape where it touches: whether it fits into the surface there (local gouge), and what it
// leaves between two tracks (scallop). Second order in the distance from the contact; lengths mm, curvatures
// 1/mm. Formulas: docs/reference/cutter.md.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/toolpath/profile.h"

namespace millwright::toolpath {

/// Principal radii of the body at its contact: infinite on a flat, 0 on a sharp edge.
struct ContactShape {
    double meridian_radius = 0.0; ///< in the section through the axis
    double parallel_radius = 0.0; ///< square to it
    Vec3 meridian = Vec3::Zero(); ///< unit tangents
    Vec3 parallel = Vec3::Zero();
};

[[nodiscard]] ContactShape contact_shape(const Profile& body, const Vec3& normal, const Vec3& axis);

/// The least curvature, over all directions, of the cutter against the surface: negative where it bites in at
/// its own contact. `normal` is that of the surface on the side of the tool. Minus infinity where the
/// tangents of the surface are parallel.
[[nodiscard]] double least_relative_curvature(const ContactShape& cutter,
                                              const geometry::SurfaceDerivatives& at,
                                              const Vec3& normal);

/// Radius of the groove that the cutter leaves across the unit direction `feed` of the move: that of its
/// outline against the move.
[[nodiscard]] double effective_radius(const ContactShape& cutter, const Vec3& normal, const Vec3& feed);

/// The surface's curvature in the tangent direction `along`, positive where it is convex for the tool.
[[nodiscard]] double
convex_curvature(const geometry::SurfaceDerivatives& at, const Vec3& normal, const Vec3& along);

/// Height of the ridge between two tracks that are `gap` apart: gap^2 (1/radius + convex) / 8, not below 0.
[[nodiscard]] double scallop_height(double radius, double convex, double gap);

/// The gap of two tracks that leaves a ridge of `height`: infinity where any does.
[[nodiscard]] double step_over(double radius, double convex, double height);

} // namespace millwright::toolpath
