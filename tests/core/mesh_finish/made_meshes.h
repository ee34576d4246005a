// Meshes of shapes that closed forms describe. Lengths mm.
#pragma once

#include "core/exchange/triangle_mesh.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace millwright::test {

/// The graph of `height` over [x0,x1] x [y0,y1] by nx x ny squares of two triangles each.
inline exchange::TriangleMesh graph_mesh(const std::array<double, 4>& area,
                                         int nx,
                                         int ny,
                                         const std::function<double(double, double)>& height) {
    exchange::TriangleMesh mesh;
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) {
            const double x = area[0] + (area[1] - area[0]) * i / nx;
            const double y = area[2] + (area[3] - area[2]) * j / ny;
            mesh.points.emplace_back(x, y, height(x, y));
        }
    }
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const int a = j * (nx + 1) + i;
            const int c = a + nx + 1;
            mesh.triangles.push_back({a, a + 1, c + 1});
            mesh.triangles.push_back({a, c + 1, c});
        }
    }
    return mesh;
}

/// Two squares of `size` at z 0 and `depth` below, and the upright wall between them in the plane x = 0.
inline exchange::TriangleMesh step_mesh(double size, double depth) {
    exchange::TriangleMesh mesh;
    mesh.points = {{-size, -size, 0.0},
                   {0.0, -size, 0.0},
                   {0.0, size, 0.0},
                   {-size, size, 0.0},
                   {0.0, -size, -depth},
                   {size, -size, -depth},
                   {size, size, -depth},
                   {0.0, size, -depth}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {1, 4, 7}, {1, 7, 2}};
    return mesh;
}

/// Triangles at random within a cube of `size`.
inline exchange::TriangleMesh random_triangles(int count, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, size);
    exchange::TriangleMesh mesh;
    for (int n = 0; n < count; ++n) {
        for (int k = 0; k < 3; ++k) {
            mesh.points.emplace_back(place(random), place(random), place(random));
        }
        mesh.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    return mesh;
}

/// Points of all triangles, `steps` a side.
inline std::vector<Vec3> dense_points(const exchange::TriangleMesh& mesh, int steps) {
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const double a = static_cast<double>(i) / steps;
                const double b = static_cast<double>(j) / steps;
                points.emplace_back(a * mesh.corner(n, 0) + b * mesh.corner(n, 1) +
                                    (1.0 - a - b) * mesh.corner(n, 2));
            }
        }
    }
    return points;
}

} // namespace millwright::test
