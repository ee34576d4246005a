#include "core/mesh_finish/cutter_outline.h"

#include "core/base/units.h"
#include "core/toolpath/cutter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::mesh_finish {
namespace {

using toolpath::CutterKind;

CutterOutline cutter(CutterKind kind, double diameter, double corner = 0.0, double half_angle = 0.1) {
    return CutterOutline(*toolpath::body_of(toolpath::CutterShape{.kind = kind,
                                                                  .diameter = diameter,
                                                                  .corner_radius = corner,
                                                                  .half_angle = half_angle,
                                                                  .length = 50.0}));
}

TEST(CutterOutline, HasTheHeightsOfItsShape) {
    EXPECT_NEAR(cutter(CutterKind::ball, 10.0).height(3.0), 1.0, 1e-14); // 5 - 4
    EXPECT_NEAR(cutter(CutterKind::flat, 10.0).height(5.0), 0.0, 1e-14);
    const CutterOutline bull = cutter(CutterKind::bull_nose, 10.0, 2.0);
    EXPECT_NEAR(bull.height(3.0), 0.0, 1e-14);
    EXPECT_NEAR(bull.height(3.0 + 1.2), 2.0 - 1.6, 1e-14);
    const CutterOutline cone = cutter(CutterKind::cone, 10.0, 1.0, from_degrees(30.0));
    const double joins = std::cos(from_degrees(30.0));
    EXPECT_NEAR(cone.height(4.0), 0.5 + (4.0 - joins) / std::tan(from_degrees(30.0)), 1e-12);
}

TEST(CutterOutline, GrowsByADistanceOnAllSides) {
    const CutterOutline ball = cutter(CutterKind::ball, 10.0).grown(2.0);
    EXPECT_NEAR(ball.radius(), 7.0, 1e-14);
    EXPECT_NEAR(ball.height(0.0), -2.0, 1e-14);
    EXPECT_NEAR(ball.height(7.0), 5.0, 1e-12); // around the same middle
    const CutterOutline flat = cutter(CutterKind::flat, 10.0).grown(2.0);
    EXPECT_NEAR(flat.height(5.0), -2.0, 1e-14);
    EXPECT_NEAR(flat.height(7.0), 0.0, 1e-12);
    const double angle = from_degrees(30.0);
    const CutterOutline cone = cutter(CutterKind::cone, 10.0, 1.0, angle);
    // Its flank, 2 mm to the side of the other along its normal.
    EXPECT_NEAR(
        cone.grown(2.0).height(4.0 + 2.0 * std::cos(angle)), cone.height(4.0) - 2.0 * std::sin(angle), 1e-12);
}

TEST(CutterOutline, RestsOnAPlaneAtTheOffsetOfABall) {
    const Vec3 normal = Vec3(1.0, 2.0, 3.0).normalized();
    const auto rest = cutter(CutterKind::ball, 6.0).on_plane({1.0, 1.0}, Vec3::Zero(), normal);
    ASSERT_TRUE(rest);
    const Vec3 middle(1.0, 1.0, rest->z + 3.0);
    EXPECT_NEAR(middle.dot(normal), 3.0, 1e-12);
    EXPECT_NEAR((middle - 3.0 * normal - rest->contact).norm(), 0.0, 1e-12);
}

TEST(CutterOutline, TurnsAPlaneThatLooksDown) {
    const Vec3 normal(0.3, 0.0, 1.0);
    const CutterOutline ball = cutter(CutterKind::ball, 6.0);
    EXPECT_NEAR(ball.on_plane({0.0, 0.0}, Vec3::Zero(), normal)->z,
                ball.on_plane({0.0, 0.0}, Vec3::Zero(), -normal)->z,
                1e-14);
    EXPECT_FALSE(ball.on_plane({0.0, 0.0}, Vec3::Zero(), Vec3::UnitX()));
}

TEST(CutterOutline, RestsOnAnEdgeAtTheDistanceOfABall) {
    const Vec3 a(-20.0, 1.0, -5.0);
    const Vec3 b(20.0, 1.0, 7.0);
    const auto rest = cutter(CutterKind::ball, 6.0).on_edge({0.0, 0.0}, a, b);
    ASSERT_TRUE(rest);
    const Vec3 middle(0.0, 0.0, rest->z + 3.0);
    EXPECT_NEAR((middle - a).cross((b - a).normalized()).norm(), 3.0, 1e-12);
    EXPECT_NEAR((middle - rest->contact).norm(), 3.0, 1e-12);
}

TEST(CutterOutline, RestsOnARisingEdgeWithTheRimOfAFlatEnd) {
    const auto rest =
        cutter(CutterKind::flat, 10.0).on_edge({0.0, 0.0}, {-20.0, 3.0, -20.0}, {20.0, 3.0, 20.0});
    ASSERT_TRUE(rest);
    EXPECT_NEAR(rest->z, 4.0, 1e-12); // sqrt(5^2 - 3^2) along the edge, which rises as far as it goes
}

TEST(CutterOutline, RestsOnAnUprightEdgeWithItsUpperEnd) {
    const auto rest = cutter(CutterKind::ball, 10.0).on_edge({0.0, 0.0}, {3.0, 0.0, 9.0}, {3.0, 0.0, -9.0});
    ASSERT_TRUE(rest);
    EXPECT_NEAR(rest->z, 8.0, 1e-12);
}

TEST(CutterOutline, PassesByWhatIsFartherThanItsRadius) {
    const CutterOutline ball = cutter(CutterKind::ball, 10.0);
    EXPECT_FALSE(ball.on_point({0.0, 0.0}, {5.001, 0.0, 0.0}));
    EXPECT_TRUE(ball.on_point({0.0, 0.0}, {5.0, 0.0, 0.0}));
    EXPECT_FALSE(ball.on_edge({0.0, 0.0}, {-9.0, 5.001, 0.0}, {9.0, 5.001, 0.0}));
    EXPECT_FALSE(ball.on_edge({0.0, 0.0}, {6.0, 0.0, 0.0}, {9.0, 0.0, 0.0}));
}

} // namespace
} // namespace millwright::mesh_finish
