// The part of a mesh that is seen from one direction, and the least rectangle around it.
#pragma once

#include "core/exchange/triangle_mesh.h"

#include <optional>
#include <vector>

namespace millwright::exchange {

struct VisibleSide {
    TriangleMesh mesh;
    std::vector<int> numbers;   ///< of its points in the whole mesh
    TriangleMesh left_out;      ///< the triangles that look the other way or sideways
    double area = 0.0;          ///< mm^2
    double left_out_area = 0.0; ///< mm^2
};

/// The mean normal of the mesh, weighted by area; +z where the mesh is closed.
[[nodiscard]] Vec3 mean_direction(const TriangleMesh& mesh);

/// The triangles that look along the unit vector `along` by more than 0.06 degrees.
[[nodiscard]] VisibleSide visible_side(const TriangleMesh& mesh, const Vec3& along);

/// A rectangle in space; the place of a point in it is a pair of numbers from 0 to 1.
struct Rectangle {
    Vec3 corner = Vec3::Zero();
    Vec3 u = Vec3::UnitX(); ///< the whole side, mm
    Vec3 v = Vec3::UnitY(); ///< the same; square to u

    [[nodiscard]] double area() const { return u.norm() * v.norm(); }
    [[nodiscard]] Vec2 place_of(const Vec3& point) const {
        return {(point - corner).dot(u) / u.squaredNorm(), (point - corner).dot(v) / v.squaredNorm()};
    }
};

/// The least rectangle around the points as seen along the unit vector `along`, its u nearest to +x and u x v
/// along `along`; the upright one if it is hardly larger. Nothing if they lie in a line.
[[nodiscard]] std::optional<Rectangle> least_rectangle(const std::vector<Vec3>& points, const Vec3& along);

// What surrounds a side of a mesh as it is seen from one direction: the corners of its outline, and its
// holes.

struct MeshOutlines {
    int corners = 0;           ///< of the longest outline: places where it turns by 45 degrees or more
    std::vector<double> holes; ///< largest width of each as it is seen, mm; the largest first
};

/// `along`: unit, the direction from which `mesh` is seen. No hole is a gap less than 0.2 mm wide, nor one
/// behind which more of the mesh is seen, as the floor of a pocket.
[[nodiscard]] MeshOutlines outlines_of(const TriangleMesh& mesh, const Vec3& along);

} // namespace millwright::exchange
