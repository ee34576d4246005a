// The patches of a design joined where they share sides (core/geometry/patch_join.h).
#pragma once

#include "core/geometry/patch_join.h"
#include "core/project/project.h"

#include <vector>

namespace millwright::project {

struct JoinedSurface {
    SurfaceInput surface;
    std::vector<geometry::Seam> seams;
    std::vector<geometry::SeamFigures> before, after; ///< one a seam
    double largest_move = 0.0;                        ///< of a control point, mm
    double rms_move = 0.0;
};

/// How far the ends of two sides may be apart that belong together, where nobody says it: a twentieth of the
/// diagonal of the smallest patch, mm.
[[nodiscard]] double usual_gap_mm(const SurfaceInput& surface);

/// Sides whose ends are at most `gap_mm` apart become one. Outlines of trimmed patches keep their parameters.
/// Throws Error if there is no such pair of sides, and as geometry::joined does.
[[nodiscard]] JoinedSurface
joined_surface(const SurfaceInput& surface, geometry::Continuity continuity, double gap_mm);

/// Adds the patches of `more` after those of `surface`.
void add_patches(SurfaceInput& surface, const SurfaceInput& more);

} // namespace millwright::project
