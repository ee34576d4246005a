#include "core/toolpath/singular_points.h"

#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

TEST(SingularPoints, OfTheDomeAreItsTopAndItsCorners) {
    const auto found = singular_points(test::patch("dome"), test::machine("rotary-tilt-listing"));
    ASSERT_EQ(found.size(), 5U);
    EXPECT_LT((found[0].uv - Vec2(0, 0)).norm(), 1e-9);
    EXPECT_LT((found[1].uv - Vec2(0, 1)).norm(), 1e-9);
    EXPECT_LT((found[2].uv - Vec2(0.5, 0.5)).norm(), 1e-9);
    EXPECT_LT((found[2].position - Vec3(46.25, 46.25, 51.0625)).norm(), 1e-9);
    EXPECT_LT((found[4].uv - Vec2(1, 1)).norm(), 1e-9);
}

TEST(SingularPoints, OfTheTwoBellsAreTheExtremaOnTheMiddleLineAndTheCorners) {
    const auto found = singular_points(test::patch("two-bell"), test::machine("ac-table"));
    ASSERT_EQ(found.size(), 7U);
    int on_middle = 0;
    for (const SingularPoint& point : found) {
        if (std::abs(point.uv.y() - 0.5) < 1e-9) {
            ++on_middle;
            const double u = point.uv.x();
            EXPECT_NEAR(3.55 + u * (-29.6 + u * (63.45 - 39.6 * u)), 0.0, 1e-8); // f'(u) = 0
        }
    }
    EXPECT_EQ(on_middle, 3);
}

TEST(SingularPoints, OfATiltedPlaneAreNone) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(1, 0) = {100, 0, 30};
    net.point(0, 1) = {0, 100, 0};
    net.point(1, 1) = {100, 100, 30};
    EXPECT_TRUE(singular_points(geometry::BezierPatch(net), test::machine("ac-table")).empty());
}

} // namespace
} // namespace millwright::toolpath
