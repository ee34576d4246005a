// How the tool leans against the surface normal: lead forward in the direction of the move, tilt to its
// right. axis = cos(lead) cos(tilt) n + sin(lead) f + cos(lead) sin(tilt) r, with n the normal, f the
// direction of the move along the surface, r = f x n to the right of it. Angles rad.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

struct Lean {
    double lead = 0.0; ///< at the start of each track
    double tilt = 0.0;
    double lead_change = 0.0; ///< up to the end of the track, linear in its parameter
    double tilt_change = 0.0;

    /// The tool stands along the normal.
    [[nodiscard]] bool upright() const;
    friend bool operator==(const Lean&, const Lean&) = default;
};

/// The tool axis for a unit `normal` and a unit direction `feed` square to it, at the parameter `along` the
/// track, 0 to 1.
[[nodiscard]] Vec3 leaning_axis(const Lean& lean, const Vec3& normal, const Vec3& feed, double along);

/// `toolpath` with the axis that leans. The direction of the move at a point is that from the point before to
/// the one after on its track. Throws Error with the node where there is none on the surface.
[[nodiscard]] Toolpath leaned(const geometry::BezierPatch& patch, const Lean& lean, Toolpath toolpath);

/// The unit direction on the surface in which the parameters change by `step`; zero where there is none.
[[nodiscard]] Vec3 surface_direction(const geometry::SurfaceDerivatives& at, const Vec2& step);

} // namespace millwright::toolpath
