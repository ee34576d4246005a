// Patches as faces of a CAD model, whole or divided, for tests.
#pragma once

#include "core/geometry/patch_refinement.h"
#include "core/geometry/presets.h"
#include "core/region/face_mesh.h"

#include <random>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::test {

inline geometry::BezierPatch patch_of(std::string_view preset) {
    return geometry::surface_preset(preset).make().patch(geometry::PatchId{0});
}

inline Vec2 place_in_square(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double u = share(random);
    return {u, share(random)};
}

/// u and v changed for each other.
inline geometry::BezierPatch swapped(const geometry::BezierPatch& patch) {
    const geometry::ControlNet& own = patch.net();
    geometry::ControlNet net = geometry::ControlNet::sized(own.columns, own.rows);
    for (int i = 0; i < own.rows; ++i) {
        for (int j = 0; j < own.columns; ++j) {
            net.point(j, i) = own.point(i, j);
        }
    }
    return geometry::BezierPatch(std::move(net));
}

/// The same surface as one span.
inline geometry::BsplineNet net_of(const geometry::BezierPatch& patch) {
    const geometry::ControlNet& own = patch.net();
    geometry::BsplineNet net;
    net.degree_u = own.rows - 1;
    net.degree_v = own.columns - 1;
    net.knots_u.assign(static_cast<std::size_t>(own.rows), 0.0);
    net.knots_u.insert(net.knots_u.end(), static_cast<std::size_t>(own.rows), 1.0);
    net.knots_v.assign(static_cast<std::size_t>(own.columns), 0.0);
    net.knots_v.insert(net.knots_v.end(), static_cast<std::size_t>(own.columns), 1.0);
    net.rows = own.rows;
    net.columns = own.columns;
    net.points = own.points;
    net.weights = own.weights;
    return net;
}

/// Numbered from 1.
inline std::vector<region::ExactFace> faces_of(const std::vector<geometry::BezierPatch>& patches) {
    std::vector<region::ExactFace> faces;
    for (const geometry::BezierPatch& patch : patches) {
        faces.push_back({geometry::BsplineSurface(net_of(patch)), static_cast<int>(faces.size()) + 1});
    }
    return faces;
}

/// Divided at u and at v: below u and v, below u and above v, above u and below v, above both.
inline std::vector<geometry::BezierPatch> quarters(const geometry::BezierPatch& whole, double u, double v) {
    const auto [low, high] = geometry::split(whole, geometry::Parameter::u, u);
    std::vector<geometry::BezierPatch> all;
    for (const geometry::BezierPatch* half : {&low, &high}) {
        auto [before, behind] = geometry::split(*half, geometry::Parameter::v, v);
        all.push_back(std::move(before));
        all.push_back(std::move(behind));
    }
    return all;
}

/// Straight between four points: at (0,0), (1,0), (0,1) and (1,1).
inline geometry::BezierPatch
bilinear(const Vec3& origin, const Vec3& at_u, const Vec3& at_v, const Vec3& at_both) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(0, 0) = origin;
    net.point(1, 0) = at_u;
    net.point(0, 1) = at_v;
    net.point(1, 1) = at_both;
    return geometry::BezierPatch(std::move(net));
}

/// A rectangle in a plane of constant z.
inline geometry::BezierPatch rectangle(double x, double y, double width, double height, double z = 0.0) {
    return bilinear({x, y, z}, {x + width, y, z}, {x, y + height, z}, {x + width, y + height, z});
}

} // namespace millwright::test
