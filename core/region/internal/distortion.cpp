#include "core/region/internal/distortion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::region {

namespace {

/// Of a triangle: E, F, G of the map from the flat to space, and areas.
struct TriangleMap {
    double E = 0.0, F = 0.0, G = 0.0;
    double area = 0.0; ///< mm^2
    double flat = 0.0; ///< with its sign
};

TriangleMap map_of(const FaceMesh& mesh, const std::vector<Vec2>& places, const FaceTriangle& triangle) {
    const auto n = [&](std::size_t k) { return static_cast<std::size_t>(triangle.corners[k]); };
    const Vec3 a = mesh.points[n(1)] - mesh.points[n(0)], b = mesh.points[n(2)] - mesh.points[n(0)];
    const Vec2 p = places[n(1)] - places[n(0)], q = places[n(2)] - places[n(0)];
    TriangleMap map;
    map.area = 0.5 * a.cross(b).norm();
    map.flat = 0.5 * cross(p, q);
    const double twice = 2.0 * map.flat;
    const Vec3 s = (q.y() * a - p.y() * b) / twice, t = (p.x() * b - q.x() * a) / twice;
    map.E = s.squaredNorm();
    map.F = s.dot(t);
    map.G = t.squaredNorm();
    return map;
}

/// Sums over the area of E, G, G/D and E/D, where D = EG - F^2.
struct Sums {
    double E = 0.0, G = 0.0, inverse_E = 0.0, inverse_G = 0.0;
    double area = 0.0, flat = 0.0;
};

Sums sums_of(const std::vector<TriangleMap>& maps) {
    Sums sums;
    for (const TriangleMap& map : maps) {
        const double D = map.E * map.G - map.F * map.F;
        sums.E += map.area * map.E;
        sums.G += map.area * map.G;
        sums.inverse_E += map.area * map.G / D;
        sums.inverse_G += map.area * map.E / D;
        sums.area += map.area;
        sums.flat += map.flat;
    }
    return sums;
}

double area_ratio(std::vector<TriangleMap> maps, const Sums& sums) {
    constexpr double share = 0.95;
    const auto ratio = [&](const TriangleMap& map) {
        const double relative = map.area / sums.area / (map.flat / sums.flat);
        return std::max(relative, 1.0 / relative);
    };
    std::ranges::sort(maps, [&](const auto& a, const auto& b) { return ratio(a) < ratio(b); });
    double below = 0.0;
    for (const TriangleMap& map : maps) {
        below += map.area;
        if (below >= share * sums.area) {
            return ratio(map);
        }
    }
    return 1.0;
}

std::vector<TriangleMap> maps_of(const FaceMesh& mesh, const std::vector<Vec2>& places) {
    std::vector<TriangleMap> maps;
    for (const FaceTriangle& triangle : mesh.triangles) {
        const TriangleMap map = map_of(mesh, places, triangle);
        if (map.area > 0.0) {
            maps.push_back(map);
        }
    }
    return maps;
}

std::vector<Vec3> folds_of(const FaceMesh& mesh, const std::vector<Vec2>& places) {
    Box3 box;
    for (const Vec2& place : places) {
        box.extend(Vec3(place.x(), place.y(), 0.0));
    }
    const double least = 1e-12 * box.sizes().x() * box.sizes().y(); // rounding beside the whole
    std::vector<Vec3> folds;
    for (const FaceTriangle& triangle : mesh.triangles) {
        const auto n = [&](std::size_t k) { return static_cast<std::size_t>(triangle.corners[k]); };
        const Vec2 p = places[n(1)] - places[n(0)], q = places[n(2)] - places[n(0)];
        if (!(0.5 * cross(p, q) > least)) {
            folds.emplace_back((mesh.points[n(0)] + mesh.points[n(1)] + mesh.points[n(2)]) / 3.0);
        }
    }
    return folds;
}

} // namespace

Vec2 extent_of(const FaceMesh& mesh, const std::vector<Vec2>& places) {
    const Sums sums = sums_of(maps_of(mesh, places));
    return {std::pow(sums.E / sums.inverse_E, 0.25), std::pow(sums.G / sums.inverse_G, 0.25)};
}

void measure(const FaceMesh& mesh, Flattening& flattening) {
    flattening.folds = folds_of(mesh, flattening.places);
    if (!flattening.folds.empty()) {
        flattening.distortion = flattening.area_ratio = std::numeric_limits<double>::infinity();
        return;
    }
    std::vector<TriangleMap> maps = maps_of(mesh, flattening.places);
    const Sums sums = sums_of(maps);
    // The scales a and b of the axes make E / a^2 + a^2 G/D + G / b^2 + b^2 E/D least.
    const double both = flattening.method == FlatteningMethod::conformal
                            ? 2.0 * std::sqrt((sums.E + sums.G) * (sums.inverse_E + sums.inverse_G))
                            : 2.0 * (std::sqrt(sums.E * sums.inverse_E) + std::sqrt(sums.G * sums.inverse_G));
    flattening.distortion = both / (4.0 * sums.area);
    flattening.area_ratio = area_ratio(std::move(maps), sums);
}

} // namespace millwright::region
