#include "core/toolpath/cutter.h"

#include "core/base/error.h"
#include "tests/core/toolpath/leans.h"
#include "tests/support/cutters.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace millwright::toolpath {
namespace {

using test::leaning;

TEST(Cutter, BallFollowsTheFormulaOfItsCentre) {
    std::mt19937 random(4);
    const Profile body = test::body(test::ball);
    for (int n = 0; n < 100; ++n) {
        const Vec3 contact = test::random_point(random, 50.0);
        const Vec3 normal = test::random_upward(random);
        const Vec3 axis = leaning(random, normal, 0.015 * n);
        const Vec3 expected = contact + 4.0 * normal - 4.0 * axis;
        EXPECT_LT((tip_for(body, contact, normal, axis) - expected).norm(), 1e-13);
    }
}

TEST(Cutter, FlatEndTouchesWithItsEdgeAndBullNoseWithItsCorner) {
    std::mt19937 random(5);
    for (int n = 1; n < 100; ++n) {
        const Vec3 contact = test::random_point(random, 50.0);
        const Vec3 normal = test::random_upward(random);
        const double angle = 0.015 * n;
        const Vec3 axis = leaning(random, normal, angle);
        const Vec3 outwards = (std::cos(angle) * axis - normal) / std::sin(angle);
        const Vec3 by_edge = contact - 5.0 * outwards;
        EXPECT_LT((tip_for(test::body(test::flat_end), contact, normal, axis) - by_edge).norm(), 1e-11);
        const Vec3 by_corner = contact + 2.0 * (normal - axis) - 4.0 * outwards;
        EXPECT_LT((tip_for(test::body(test::bull_nose), contact, normal, axis) - by_corner).norm(), 1e-11);
    }
}

TEST(Cutter, AlongTheNormalTheTipIsTheContact) {
    std::mt19937 random(6);
    for (const CutterShape& shape : test::every_cutter) {
        const Vec3 contact = test::random_point(random, 50.0);
        const Vec3 normal = test::random_upward(random);
        EXPECT_LT((tip_for(test::body(shape), contact, normal, normal) - contact).norm(), 1e-12);
    }
}

/// No point of the body is behind the tangent plane, and one is on it: at the contact.
TEST(Cutter, EveryBodyRestsOnTheTangentPlaneAtTheContact) {
    std::mt19937 random(7);
    for (const CutterShape& shape : test::every_cutter) {
        const Profile body = test::body(shape);
        for (const double angle : {0.1, 0.6, 1.1, 1.5}) {
            const Vec3 normal = test::random_upward(random);
            const Vec3 axis = leaning(random, normal, angle);
            const Vec3 contact = test::random_point(random, 50.0);
            const Vec3 tip = tip_for(body, contact, normal, axis);
            const std::vector<Vec3> points = test::surface_points(shape, axis, 150, 360);
            const auto lower = [&](const Vec3& p, const Vec3& q) { return p.dot(normal) < q.dot(normal); };
            const Vec3 lowest = tip + *std::min_element(points.begin(), points.end(), lower);
            EXPECT_NEAR((lowest - contact).dot(normal), 0.0, 2e-3);
            EXPECT_GE((lowest - contact).dot(normal), -1e-9);
            const bool along_a_line = std::abs(angle - (0.5 * pi - shape.half_angle)) < 0.05;
            EXPECT_TRUE(along_a_line || (lowest - contact).norm() < 0.25) << (lowest - contact).norm();
        }
    }
}

TEST(Cutter, TellsWhatIsWrongWithAShape) {
    const auto fault = [](CutterShape shape) { return fault_of(shape); };
    EXPECT_EQ(fault_of(CutterShape{}), "");
    for (const CutterShape& shape : test::every_cutter) {
        EXPECT_EQ(fault_of(shape), "");
    }
    EXPECT_EQ(fault({.kind = CutterKind::ball, .diameter = 0.0}),
              "the diameter and the length of a cutter must be above 0 mm");
    EXPECT_EQ(fault({.kind = CutterKind::ball, .diameter = 6.0, .length = 2.0}),
              "a cutter of length 2 mm ends below its shank, which starts at 3 mm");
    EXPECT_EQ(fault({.kind = CutterKind::bull_nose, .diameter = 6.0, .corner_radius = 4.0}),
              "a corner radius of 4 mm does not fit into a diameter of 6 mm");
    EXPECT_EQ(fault({.kind = CutterKind::cone, .diameter = 2.0, .corner_radius = 3.0}),
              "a tip radius of 3 mm is too large for a shank diameter of 2 mm");
    EXPECT_EQ(fault({.kind = CutterKind::cone, .half_angle = 0.0}),
              "the half angle of a tapered cutter must be between 0 and 90 deg, not 0");
    EXPECT_THROW((void)body_of(CutterShape{.kind = CutterKind::flat, .diameter = -1.0}), Error);
    EXPECT_THROW((void)body_of(HolderShape{.diameter = 20.0, .length = 0.0}, 30.0), Error);
}

TEST(Cutter, APointHasNoBodyAndAHolderBeginsWhereTheCutterEnds) {
    EXPECT_FALSE(body_of(CutterShape{}));
    EXPECT_FALSE(body_of(HolderShape{}, 30.0));
    const auto holder = body_of(HolderShape{.diameter = 20.0, .length = 40.0}, 30.0);
    ASSERT_TRUE(holder);
    EXPECT_NEAR(holder->near({0.0, 29.0}).distance, 1.0, 1e-12);
    EXPECT_NEAR(holder->near({12.0, 50.0}).distance, 2.0, 1e-12);
    EXPECT_NEAR(holder->near({0.0, 69.0}).distance, -1.0, 1e-12);
}

} // namespace
} // namespace millwright::toolpath
