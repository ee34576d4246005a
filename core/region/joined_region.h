// A region of several faces that continue one another: welded, spread out on the unit square, and every point
// of it brought back to the exact faces.
#pragma once

#include "core/region/face_mesh.h"
#include "core/region/flattening.h"
#include "core/region/region.h"

#include <array>
#include <optional>
#include <span>

namespace millwright::region {

struct JoinSettings {
    FaceMeshSettings mesh;
    /// Places next to which the corners of the square lie on the boundary, mm, in any order, (0,0) first; by
    /// `flattened` otherwise.
    std::optional<std::array<Vec3, 4>> corners;
};

/// Beyond this angle between normals a border is sharp, rad. A smooth map rounds it off.
inline constexpr double sharp_border = 0.05;

struct JoinedRegion {
    Region region;
    FaceMesh mesh;
    Flattening flattening; ///< of the mesh
    /// How far the border of the region is at most from the boundary of the faces, beyond it or short of it,
    /// at 256 places of each side, mm. Beyond it the faces are continued.
    double boundary_off = 0.0;
};

/// Throws Error with the place as `face_mesh` and `flattened`, where a border is sharp and where the smooth
/// map folds; Cancelled.
[[nodiscard]] JoinedRegion
joined_region(std::span<const ExactFace> faces, const JoinSettings& settings, const Progress& progress);

} // namespace millwright::region
