// What is odd about a mesh that is to be finished, each kind counted and with the place of the first. None of
// it keeps a cutter from resting on the triangles as they are. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace millwright::mesh_finish {

struct OddPlace {
    int count = 0;
    Vec3 first = Vec3::Zero(); ///< in the order of the triangles
};

struct MeshInspection {
    OddPlace open_edges;     ///< of one triangle
    OddPlace shared_by_many; ///< edges of more than two
    OddPlace turned_over;    ///< edges whose two triangles do not look to the same side
    OddPlace slivers;        ///< triangles less high than a thousandth of their longest edge
    /// Bit k for the edge from corner k to the next where it is open; one entry per triangle.
    std::vector<std::uint8_t> open;
};

/// Throws Cancelled.
[[nodiscard]] MeshInspection inspect(const exchange::TriangleMesh& mesh, const Progress& progress);

/// Bytes that it takes of a mesh of so many triangles while it runs.
[[nodiscard]] std::size_t inspection_memory(std::size_t triangles);

/// A sentence for each kind that is there.
[[nodiscard]] std::vector<std::string> remarks_of(const MeshInspection& found);

/// Coordinates are written with so many mm at most: beyond them a double has no micrometres left to compute
/// with.
inline constexpr double farthest_mm = 1e5;

/// Throws Error, with the place, unless there is a triangle and every point is finite and within farthest_mm.
void expect_usable(const exchange::TriangleMesh& mesh);

} // namespace millwright::mesh_finish
