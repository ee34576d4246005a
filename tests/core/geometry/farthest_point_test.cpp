#include "core/geometry/presets.h"
#include "core/geometry/surface_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::geometry {
namespace {

/// A quarter of a torus of radii 30 and 10 about z, its upper outer quarter.
BezierPatch torus_quarter() {
    ControlNet net = ControlNet::sized(3, 3);
    const Vec3 around_x(1.0, 1.0, 0.0);
    const Vec3 around_y(0.0, 1.0, 1.0);
    const Vec3 out(40.0, 40.0, 30.0);
    const Vec3 up(0.0, 10.0, 10.0);
    const Vec3 weight(1.0, std::sqrt(0.5), 1.0);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            net.point(i, j) = {around_x[i] * out[j], around_y[i] * out[j], up[j]};
            net.weight(i, j) = weight[i] * weight[j];
        }
    }
    return BezierPatch(net);
}

TEST(FarthestPoint, OfATorusIsThatOfTheFormula) {
    const BezierPatch patch = torus_quarter();
    for (const Vec3& direction : {Vec3(1, 1, 0), Vec3(1, 2, 3), Vec3(0, 0, 1), Vec3(2, 1, 0.5)}) {
        const double exact =
            30.0 * std::hypot(direction.x(), direction.y()) + 10.0 * direction.norm(); // support function
        const FarthestPoint found = farthest_point(patch, direction);
        EXPECT_NEAR(found.along, exact, 1e-6) << direction.transpose();
        const Vec3 at = patch.position(found.parameters.x(), found.parameters.y());
        EXPECT_NEAR(at.dot(direction), found.along, 1e-9);
    }
}

TEST(FarthestPoint, IsNeverNearerThanAFineRasterNorFartherThanTheNet) {
    for (const auto& known : surface_presets()) {
        const Surface surface = known.make();
        for (const BezierPatch& patch : surface.patches()) {
            for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, -1, 2)}) {
                double raster = -1e9;
                for (int i = 0; i <= 200; ++i) {
                    for (int j = 0; j <= 200; ++j) {
                        raster = std::max(raster, patch.position(i / 200.0, j / 200.0).dot(direction));
                    }
                }
                const double found = farthest_point(patch, direction).along;
                EXPECT_GE(found, raster - 1e-6) << known.id;
                EXPECT_LT(found, raster + 0.02) << known.id;
            }
        }
    }
}

TEST(FarthestPoint, OfAFlatPatchIsACorner) {
    ControlNet net = ControlNet::sized(2, 2);
    net.point(0, 1) = {0.0, 5.0, 1.0};
    net.point(1, 0) = {7.0, 0.0, 2.0};
    net.point(1, 1) = {7.0, 5.0, 3.0};
    const FarthestPoint found = farthest_point(BezierPatch(net), Vec3::UnitZ());
    EXPECT_EQ(found.parameters, Vec2(1.0, 1.0));
    EXPECT_EQ(found.along, 3.0);
}

} // namespace
} // namespace millwright::geometry
