#include "core/geometry/solid.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <gtest/gtest.h>

#include <map>

namespace millwright::geometry {
namespace {

SolidMesh link() {
    return hull_of(
        std::vector<Circle>{{{0.0, 0.0}, 50.0}, {{200.0, 40.0}, 30.0}}, {-10.0, 20.0, 2.0}, Vec3::Ones());
}

/// By the divergence theorem; right only for a closed surface whose triangles all look outwards.
double volume(const SolidMesh& mesh) {
    double six_times = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](int n) { return mesh.positions[static_cast<std::size_t>(n)]; };
        six_times += at(a).dot(at(b).cross(at(c)));
    }
    return six_times / 6.0;
}

TEST(Solid, ACylinderHasItsVolume) {
    const SolidMesh mesh = hull_of(std::vector<Circle>{{{7.0, -3.0}, 50.0}}, {5.0, 45.0, 0.0}, Vec3::Ones());
    const double round = pi * 50.0 * 50.0 * 40.0;
    EXPECT_LT(volume(mesh), round);
    EXPECT_GT(volume(mesh), 0.99 * round); // forty sides
}

TEST(Solid, ALinkHasTheVolumeOfTwoCirclesAndTheirTangents) {
    // Area of the hull of two circles (r, s) whose centres are d apart: the trapezoids between the tangents
    // and the sectors outside of them.
    const double r = 50.0, s = 30.0, d = std::hypot(200.0, 40.0);
    const double lean = std::asin((r - s) / d);
    const double area = (r + s) * d * std::cos(lean) + r * r * (pi / 2.0 + lean) + s * s * (pi / 2.0 - lean);
    const SolidMesh sharp =
        hull_of(std::vector<Circle>{{{0.0, 0.0}, r}, {{200.0, 40.0}, s}}, {0.0, 10.0, 0.0}, Vec3::Ones());
    EXPECT_NEAR(volume(sharp), 10.0 * area, 0.005 * 10.0 * area);
    EXPECT_LT(volume(link()), 30.0 * area); // of which the broken edges take a little
    EXPECT_GT(volume(link()), 0.97 * 30.0 * area);
}

TEST(Solid, IsClosed) {
    const SolidMesh mesh = link();
    std::map<std::array<std::array<double, 3>, 2>, int> edges; // by place: rings share none
    const auto place = [&](int n) {
        const Vec3& p = mesh.positions[static_cast<std::size_t>(n)];
        return std::array<double, 3>{p.x(), p.y(), p.z()};
    };
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto from = place(t[k]), to = place(t[(k + 1) % 3]);
            if (from != to) {
                ++edges[{from, to}];
                --edges[{to, from}];
            }
        }
    }
    for (const auto& [edge, surplus] : edges) {
        EXPECT_EQ(surplus, 0);
    }
}

TEST(Solid, NormalsAreUnitAndLookOutwards) {
    const SolidMesh mesh = link();
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const auto& t : mesh.triangles) {
        const auto at = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
        const Vec3 across = (at(1) - at(0)).cross(at(2) - at(0));
        for (const int corner : t) {
            const Vec3& normal = mesh.normals[static_cast<std::size_t>(corner)];
            EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
            if (across.norm() > 1e-9) {
                EXPECT_GT(normal.dot(across.normalized()), 0.9);
            }
        }
    }
}

TEST(Solid, RefusesWhatHasNoInside) {
    EXPECT_THROW((void)hull_of({}, {0.0, 1.0, 0.0}, Vec3::Ones()), Defect);
    const std::vector<Circle> thin{{{0.0, 0.0}, 1.0}};
    EXPECT_THROW((void)hull_of(thin, {0.0, 10.0, 2.0}, Vec3::Ones()), Defect);
    EXPECT_THROW((void)hull_of(thin, {0.0, 0.0, 0.0}, Vec3::Ones()), Defect);
}

} // namespace
} // namespace millwright::geometry
