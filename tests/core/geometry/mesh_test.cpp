#include "core/geometry/mesh.h"

#include "core/geometry/presets.h"

#include <gtest/gtest.h>

namespace millwright::geometry {
namespace {

TEST(Tessellation, CoversThePatchWithTrianglesThatTurnWithTheNormal) {
    const BezierPatch patch = surface_preset("dome").make().patch(PatchId{0});
    const Mesh mesh = tessellate(patch, 12, 7);
    ASSERT_EQ(mesh.positions.size(), 13U * 8U);
    ASSERT_EQ(mesh.triangles.size(), 2U * 12U * 7U);
    double projected_area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.positions[static_cast<std::size_t>(a)];
        const Vec3 turn = (mesh.positions[static_cast<std::size_t>(b)] - p)
                              .cross(mesh.positions[static_cast<std::size_t>(c)] - p);
        EXPECT_GT(turn.dot(mesh.normals[static_cast<std::size_t>(a)]), 0.0);
        projected_area += 0.5 * turn.z();
    }
    EXPECT_NEAR(projected_area, 80.0 * 80.0, 1e-9);
}

TEST(Tessellation, HasFiniteNormalsWhereTheEdgeCollapses) {
    ControlNet net = surface_preset("dome").make().patch(PatchId{0}).net();
    for (int j = 0; j < 4; ++j) {
        net.point(0, j) = {0.0, 45.0, 0.0};
    }
    for (const Vec3& normal : tessellate(BezierPatch(net), 8, 8).normals) {
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    }
}

} // namespace
} // namespace millwright::geometry
