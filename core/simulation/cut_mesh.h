// The surface of what is left, as a closed mesh to look at and to hand on. Between the points of the field's
// lattice where one is material and its neighbour is not, the surface passes exactly where the line between
// them is cut; each cell of eight points has one corner of the mesh, in the middle of these places. So flat
// faces and smooth ones are within a fraction of the square of the cell, and sharp edges are broken by up to
// half a cell: figures come from the lines, not from the mesh. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/dexel_field.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace millwright::simulation {

struct CutMesh {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< counter-clockwise seen from outside
    std::vector<std::int32_t> moves;           ///< one per point: that made it, or stock_surface
    int stride = 1;                            ///< cells between the lattice points that were looked at
};

/// With about so many triangles at most; lattice points are left out until it fits. Throws Cancelled.
[[nodiscard]] CutMesh mesh_of(const DexelField& field, std::size_t most_triangles, const Progress& progress);

/// One per point: the mean of those of the triangles around, by area.
[[nodiscard]] std::vector<Vec3> normals_of(const CutMesh& mesh);

/// A binary STL file.
[[nodiscard]] std::string stl_of(const CutMesh& mesh);
/// A binary PLY file with a colour a point, 0 to 255.
[[nodiscard]] std::string ply_of(const std::vector<Vec3>& points,
                                 const std::vector<std::array<int, 3>>& triangles,
                                 const std::vector<std::array<std::uint8_t, 3>>& colors);

} // namespace millwright::simulation
