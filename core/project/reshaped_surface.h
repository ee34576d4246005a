// The patches of a design by other control points: the same shape (core/geometry/patch_refinement.h), or the
// whole part laid on another side.
#pragma once

#include "core/geometry/patch_refinement.h"
#include "core/project/project.h"

namespace millwright::project {

/// A patch of the design with a net of other degrees. Throws Error where a degree would sink, which would
/// change the shape, or is above geometry::max_degree, or where there is no such patch.
[[nodiscard]] SurfaceInput with_degrees(SurfaceInput surface, int patch, int degree_u, int degree_v);

/// The whole part turned about its origin: about X, then Y, then Z, degrees, counter-clockwise seen from the
/// axis' end. Quarter turns are exact. Throws Error where an angle is not finite.
[[nodiscard]] SurfaceInput with_turn(SurfaceInput surface, const Vec3& degrees);

/// The narrowest part of a patch that a split leaves, as a share of its parameter.
inline constexpr double narrowest_split = 0.01;

/// A patch of the design in two, where `parameter` is `at`: the second one comes right after the first. What
/// a trimmed patch has on neither side of the line is left out. The machined patch stays it, or becomes the
/// first of its halves. Throws Error where a part would be narrower than
/// narrowest_split, or where there is no such patch.
[[nodiscard]] SurfaceInput
with_split(SurfaceInput surface, int patch, geometry::Parameter parameter, double at);

/// The same of a whole project: what was painted on the machined patch, and the outline of the region, stay
/// where they are in space. A region that lies on the part alone that is no longer machined is gone, which
/// is everywhere. Throws Error also where the outline would have more than grid::most_corners.
[[nodiscard]] Project with_split(Project project, int patch, geometry::Parameter parameter, double at);

} // namespace millwright::project
