// Whether the inside of a body can be seen.
#pragma once

#include "core/geometry/solid.h"

namespace millwright::geometry {

/// Whether the triangles enclose their inside and look outwards: each edge is passed as often one way as the
/// other, and the volume by the divergence theorem is positive. Corners are the same where their coordinates
/// are equal. Throws Defect for an index outside.
[[nodiscard]] bool is_closed(const SolidMesh& mesh);

} // namespace millwright::geometry
