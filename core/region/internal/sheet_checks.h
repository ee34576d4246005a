// What makes welded triangles one sheet that can be spread out flat: one side, one boundary, nothing twice.
#pragma once

#include "core/region/face_mesh.h"

#include <span>
#include <vector>

namespace millwright::region {

/// Per face, whether its normal has to be turned over to agree with that of the first. Throws Error where
/// faces do not hang together, or only as a strip with a single side.
[[nodiscard]] std::vector<bool> turned_faces(std::span<const ExactFace> faces, const FaceMesh& mesh);

/// Points of the boundary, counter-clockwise. Throws Error with the place for a closed shell, a hole, a ring
/// and where faces touch at a point alone.
[[nodiscard]] std::vector<int> boundary_of(const FaceMesh& mesh);

/// Throws Error with the place where faces lie on one another; Cancelled.
void refuse_overlaps(std::span<const ExactFace> faces,
                     const FaceMesh& mesh,
                     double tolerance,
                     const Progress& progress);

} // namespace millwright::region
