// Triangles as other programs write them: no parameters, no promise of order or of a closed body.
#pragma once

#include "core/geometry/vectors.h"

#include <array>
#include <vector>

namespace millwright::exchange {

struct TriangleMesh {
    std::vector<Vec3> points;                  ///< mm, each place once
    std::vector<std::array<int, 3>> triangles; ///< indices of three different points

    [[nodiscard]] const Vec3& corner(std::size_t triangle, int k) const {
        return points[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(k)])];
    }
    /// Normal to the triangle by the right-hand rule; its length is twice the area, mm^2.
    [[nodiscard]] Vec3 doubled_area(std::size_t triangle) const {
        const Vec3& a = corner(triangle, 0);
        return (corner(triangle, 1) - a).cross(corner(triangle, 2) - a);
    }
};

[[nodiscard]] inline TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Vec3& point : mesh.points) {
        point *= factor;
    }
    return mesh;
}

} // namespace millwright::exchange
