// What surrounds a side of a mesh as it is seen from one direction: the corners of its outline, and its
// holes.
#pragma once

#include "core/exchange/triangle_mesh.h"

#include <vector>

namespace millwright::exchange {

struct MeshOutlines {
    int corners = 0;           ///< of the longest outline: places where it turns by 45 degrees or more
    std::vector<double> holes; ///< largest width of each as it is seen, mm; the largest first
};

/// `along`: unit, the direction from which `mesh` is seen. No hole is a gap less than 0.2 mm wide, nor one
/// behind which more of the mesh is seen, as the floor of a pocket.
[[nodiscard]] MeshOutlines outlines_of(const TriangleMesh& mesh, const Vec3& along);

} // namespace millwright::exchange
