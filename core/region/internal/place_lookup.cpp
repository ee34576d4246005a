#include "core/region/internal/place_lookup.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace millwright::region {

namespace {

int cell(double coordinate, int side) {
    return std::clamp(static_cast<int>(coordinate * side), 0, side - 1);
}

} // namespace

PlaceLookup::PlaceLookup(std::shared_ptr<const FaceMesh> mesh, std::vector<Vec2> places)
    : mesh_(std::move(mesh)), places_(std::move(places)), cells_(static_cast<std::size_t>(side * side)) {
    for (int n = 0; n < std::ssize(mesh_->triangles); ++n) {
        Eigen::AlignedBox2d box;
        for (const int corner : mesh_->triangles[static_cast<std::size_t>(n)].corners) {
            box.extend(places_[static_cast<std::size_t>(corner)]);
        }
        for (int i = cell(box.min().x(), side); i <= cell(box.max().x(), side); ++i) {
            for (int j = cell(box.min().y(), side); j <= cell(box.max().y(), side); ++j) {
                cells_[static_cast<std::size_t>(i * side + j)].push_back(n);
            }
        }
    }
}

std::array<double, 3> PlaceLookup::shares(const FaceTriangle& triangle, const Vec2& place) const {
    const auto corner = [&](std::size_t k) -> const Vec2& {
        return places_[static_cast<std::size_t>(triangle.corners[k])];
    };
    const Vec2 a = corner(1) - corner(0), b = corner(2) - corner(0), p = place - corner(0);
    const double area = cross(a, b);
    const double second = cross(p, b) / area, third = cross(a, p) / area;
    return {1.0 - second - third, second, third};
}

OnFace PlaceLookup::at(const Vec2& place) const {
    OnFace found;
    double best = -std::numeric_limits<double>::infinity();
    const int i = cell(place.x(), side), j = cell(place.y(), side);
    for (const int n : cells_[static_cast<std::size_t>(i * side + j)]) {
        const FaceTriangle& triangle = mesh_->triangles[static_cast<std::size_t>(n)];
        const std::array<double, 3> here = shares(triangle, place);
        const double least = *std::ranges::min_element(here);
        if (least > best) {
            best = least;
            found.face = triangle.face;
            found.uv = here[0] * triangle.parameters[0] + here[1] * triangle.parameters[1] +
                       here[2] * triangle.parameters[2];
        }
        if (least >= 0.0) {
            break;
        }
    }
    return found;
}

Eigen::AlignedBox2d PlaceLookup::places_of(int face, const Vec2& low, const Vec2& high) const {
    const Eigen::AlignedBox2d part(low, high);
    Eigen::AlignedBox2d all;
    for (const FaceTriangle& triangle : mesh_->triangles) {
        Eigen::AlignedBox2d own;
        for (const Vec2& uv : triangle.parameters) {
            own.extend(uv);
        }
        if (triangle.face == face && own.intersects(part)) {
            for (const int corner : triangle.corners) {
                all.extend(places_[static_cast<std::size_t>(corner)]);
            }
        }
    }
    return all;
}

} // namespace millwright::region
