// The patches of a design joined where they share sides (core/geometry/patch_join.h).
#pragma once

#include "core/geometry/patch_join.h"
#include "core/project/project.h"

#include <string>
#include <vector>

namespace millwright::project {

/// Two sides that face each other across a gap too wide to be closed: their ends are further apart than that.
struct OpenSeam {
    geometry::Seam seam;
    double gap = 0.0; ///< largest distance of the two sides at the same parameter, mm
};

struct JoinedSurface {
    SurfaceInput surface;
    std::vector<geometry::Seam> seams;
    std::vector<geometry::SeamFigures> before, after; ///< one per seam
    std::vector<OpenSeam> open;                       ///< before joining, nearest first
    double largest_move = 0.0;                        ///< of a control point, mm
    double rms_move = 0.0;
};

/// How far the ends of two sides may be apart that belong together, where that is not given: a twentieth of
/// the diagonal of the smallest patch, mm.
[[nodiscard]] double usual_gap_mm(const SurfaceInput& surface);

/// "0 u = 1 - 1 v = 0": the patches with their sides.
[[nodiscard]] std::string seam_text(const geometry::Seam& seam);

/// "0 u = 1 - 1 v = 0 with a gap of 2.5000 mm, ...": the first eight, and how many more there are.
[[nodiscard]] std::string open_text(const std::vector<OpenSeam>& open);

/// Sides whose ends are at most `gap_mm` apart become one. Outlines of trimmed patches keep their parameters.
/// Throws Error if there is no such pair of sides, naming what is left open, and as geometry::joined does.
[[nodiscard]] JoinedSurface
joined_surface(const SurfaceInput& surface, geometry::Continuity continuity, double gap_mm);

/// Adds the patches of `more` after those of `surface`.
void add_patches(SurfaceInput& surface, const SurfaceInput& more);

} // namespace millwright::project
