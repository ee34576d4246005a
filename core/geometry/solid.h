// Bodies to look at: triangles in colours, and the one shape of which ours are made: the outline around a row
// of circles, drawn out along z, its edges broken. Lengths mm.
#pragma once

#include "core/geometry/vectors.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace millwright::geometry {

/// Triangles of one colour.
struct SolidMesh {
    Vec3 color = Vec3::Constant(0.5);          ///< sRGB, 0 to 1
    std::vector<Vec3> positions;               ///<
    std::vector<Vec3> normals;                 ///< unit, outwards; one per position
    std::vector<std::array<int, 3>> triangles; ///< indices, counter-clockwise seen from outside
};

/// What moves as one.
struct SolidBody {
    std::string name;
    std::vector<SolidMesh> meshes;
};

struct Circle {
    Vec2 center = Vec2::Zero();
    double radius = 1.0;
};

/// From `bottom` to `top` along z.
struct Extent {
    double bottom = 0.0;
    double top = 1.0;
    double broken_edge = 2.0; ///< of the rims, under 45 degrees; 0: sharp
};

/// The convex outline around `circles`, drawn out along z. One circle gives a cylinder, two a link, four at
/// the corners of a rectangle a plate with rounded corners. Throws Defect without a circle, for radii not
/// above the broken edge, and for an extent that is not above two of them.
[[nodiscard]] SolidMesh hull_of(std::span<const Circle> circles, const Extent& extent, const Vec3& color);

/// The mesh where `a_T_b` takes it.
[[nodiscard]] SolidMesh moved(SolidMesh mesh, const Frame& a_T_b);

// Whether the inside of a body can be seen.

/// Whether the triangles enclose their inside and look outwards: each edge is passed as often one way as the
/// other, and the volume by the divergence theorem is positive. Corners are the same where their coordinates
/// are equal. Throws Defect for an index outside.
[[nodiscard]] bool is_closed(const SolidMesh& mesh);

} // namespace millwright::geometry
