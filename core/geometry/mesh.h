// Triangles of a surface, for looking at it.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/trim.h"

#include <array>
#include <vector>

namespace millwright::geometry {

// Triangles of the parameters of a trimmed patch whose edges follow its outlines exactly.

/// Triangles of [0,1]^2, counterclockwise. Every edge belongs to two of them or lies on the border of the
/// square: however they are moved, no crack opens between them.
struct TrimmedSquare {
    std::vector<Vec2> places;
    std::vector<std::array<int, 3>> inside;  ///< of what the outlines leave
    std::vector<std::array<int, 3>> outside; ///< the rest
};

/// Two triangles for each of nu x nv equal cells, more where an outline comes through one. Loops that cross
/// themselves or each other are followed exactly up to 1,000 crossings beside each other in a row of cells,
/// beyond that to within the slices of the row. Throws Defect if nu or nv < 1.
[[nodiscard]] TrimmedSquare trimmed_square(const Trim& trim, int nu, int nv);

struct Mesh {
    std::vector<Vec3> positions;               ///< mm
    std::vector<Vec3> normals;                 ///< unit, one per position; the neighbour's where degenerate
    std::vector<Vec2> parameters;              ///< (u, v), one per position
    std::vector<std::array<int, 3>> triangles; ///< indices, counter-clockwise seen against the normal
};

/// A mesh of (nu+1) x (nv+1) points at equal parameter steps, rows along u. Throws Defect if nu or nv < 1.
[[nodiscard]] Mesh tessellate(const ParametricSurface& surface, int nu, int nv);

/// `mesh` has the triangles that the outlines leave, `outside` the others between the same points.
struct TrimmedMesh {
    Mesh mesh;
    std::vector<std::array<int, 3>> outside;
};

/// The same with more points along the outlines, which edges of triangles follow.
[[nodiscard]] TrimmedMesh tessellate(const ParametricSurface& surface, const Trim& trim, int nu, int nv);

} // namespace millwright::geometry
