#include "core/toolpath/contact_shape.h"

#include "core/toolpath/body_clearance.h"
#include "tests/core/toolpath/leans.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace millwright::toolpath {
namespace {

using test::leaning;

/// A valley along x, or with `bend_x` a bowl or a saddle: z = (bend_x x^2 + bend_y y^2) / 2, as a biquadratic
/// patch.
geometry::BezierPatch bent(double bend_x, double bend_y) {
    constexpr double half = 20.0;
    geometry::ControlNet net = geometry::ControlNet::sized(3, 3);
    const auto height = [](double bend, int k) { return 0.5 * bend * half * half * (k == 1 ? -1.0 : 1.0); };
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            net.point(i, j) = {half * (i - 1), half * (j - 1), height(bend_x, i) + height(bend_y, j)};
        }
    }
    return geometry::BezierPatch(net);
}

double least_in_the_middle(const geometry::BezierPatch& patch, const CutterShape& cutter, const Vec3& axis) {
    return least_relative_curvature(
        contact_shape(test::body(cutter), Vec3::UnitZ(), axis), patch.derivatives(0.5, 0.5), Vec3::UnitZ());
}

/// A ball of radius r in a valley of radius R gouges where R < r: 1/r - 1/R.
TEST(LocalGouge, OfABallInAValleyFollowsTheClosedForm) {
    for (const double radius : {2.0, 3.9, 4.1, 9.0}) {
        const double least = least_in_the_middle(bent(0.0, 1.0 / radius), test::ball, Vec3::UnitZ());
        EXPECT_NEAR(least, std::min(1.0 / 4.0, 1.0 / 4.0 - 1.0 / radius), 1e-12);
        EXPECT_EQ(least < 0.0, radius < 4.0);
    }
}

/// A flat end along the normal bites wherever the surface is concave in one direction; leaning by p into the
/// direction of the valley it has the radius R / sin p across.
TEST(LocalGouge, OfAFlatEndOnASaddleDependsOnItsLean) {
    const auto saddle = bent(-0.01, 0.02);
    EXPECT_NEAR(least_in_the_middle(saddle, test::flat_end, Vec3::UnitZ()), -0.02, 1e-12);
    EXPECT_NEAR(least_in_the_middle(bent(-0.01, -0.02), test::flat_end, Vec3::UnitZ()), 0.01, 1e-12);
    for (const double lean : {0.05, 0.2, 0.6}) {
        const Vec3 axis(std::sin(lean), 0.0, std::cos(lean));
        EXPECT_NEAR(least_in_the_middle(saddle, test::flat_end, axis), std::sin(lean) / 5.0 - 0.02, 1e-6);
    }
}

/// The sign decides what happens next to the contact: there the body is in the part, or it is not.
TEST(LocalGouge, TellsWhetherSurfacePointsNextToTheContactAreCut) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> bend(-0.6, 0.6);
    int gouges = 0;
    for (const CutterShape& shape : {test::ball, test::bull_nose, test::cone}) {
        const Profile body = test::body(shape);
        for (int n = 0; n < 60; ++n) {
            const auto patch = bent(bend(random), bend(random));
            const Vec3 axis = leaning(random, Vec3::UnitZ(), 0.3);
            const double least = least_in_the_middle(patch, shape, axis);
            const geometry::ToolPose pose{tip_for(body, patch.position(0.5, 0.5), Vec3::UnitZ(), axis), axis};
            double deepest = std::numeric_limits<double>::infinity();
            for (int k = 0; k < 720; ++k) {
                const double angle = pi * k / 360.0;
                const Vec3 at = patch.position(0.5 + 0.002 * std::cos(angle),
                                               0.5 + 0.002 * std::sin(angle)); // 0.08 mm away
                deepest = std::min(deepest, distance(body, pose, at));
            }
            if (std::abs(least) > 0.02) {
                EXPECT_EQ(deepest < 0.0, least < 0.0) << least << " and " << deepest;
                gouges += least < 0.0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(gouges, 30);
}

/// The groove of a straight move is the outline of the body against the move: its curvature at the contact,
/// from a cloud of points.
TEST(EffectiveRadius, IsThatOfTheOutlineAgainstTheMove) {
    std::mt19937 random(13);
    for (const CutterShape& shape : {test::ball, test::bull_nose, test::flat_end}) {
        const Vec3 normal = Vec3::UnitZ();
        const Vec3 feed = Vec3::UnitX();
        const Vec3 axis = leaning(random, normal, 0.35);
        const ContactShape contact = contact_shape(test::body(shape), normal, axis);
        const double radius = effective_radius(contact, normal, feed);
        // The outline's support function h(angle) around the contact has h + h'' = its radius.
        const std::vector<Vec3> points = test::surface_points(shape, axis, 250, 1440);
        const auto support = [&](double angle) {
            const Vec3 d = -std::cos(angle) * Vec3::UnitZ() + std::sin(angle) * Vec3::UnitY();
            double h = -std::numeric_limits<double>::infinity();
            for (const Vec3& p : points) {
                h = std::max(h, d.dot(p));
            }
            return h;
        };
        constexpr double a = 0.1;
        const double measured = support(0.0) + (support(a) - 2.0 * support(0.0) + support(-a)) / (a * a);
        EXPECT_NEAR(radius, measured, 0.03 * radius);
    }
}

TEST(EffectiveRadius, OfAFlatEndThatLeadsIsTheKnownOne) {
    const double lead = 0.2;
    const Vec3 axis(std::sin(lead), 0.0, std::cos(lead));
    const ContactShape contact = contact_shape(test::body(test::flat_end), Vec3::UnitZ(), axis);
    EXPECT_NEAR(effective_radius(contact, Vec3::UnitZ(), Vec3::UnitX()), 5.0 / std::sin(lead), 1e-9);
    EXPECT_NEAR(effective_radius(contact, Vec3::UnitZ(), Vec3::UnitY()), 0.0, 1e-9);
}

TEST(Scallop, HeightAndStepOverBelongTogether) {
    EXPECT_NEAR(scallop_height(4.0, 0.0, 1.0), 1.0 / 32.0, 1e-15);
    const double exact = 4.0 - std::sqrt(16.0 - 0.25);
    EXPECT_NEAR(scallop_height(4.0, 0.0, 1.0), exact, 0.005 * exact);
    for (const double convex : {-0.1, 0.0, 0.3}) {
        EXPECT_NEAR(scallop_height(4.0, convex, step_over(4.0, convex, 0.01)), 0.01, 1e-15);
    }
    EXPECT_TRUE(std::isinf(step_over(std::numeric_limits<double>::infinity(), 0.0, 0.01)));
    EXPECT_EQ(scallop_height(4.0, -0.5, 1.0), 0.0);
}

TEST(Scallop, ConvexCurvatureIsPositiveOnADome) {
    const auto patch = bent(-0.05, 0.02);
    const auto at = patch.derivatives(0.5, 0.5);
    EXPECT_NEAR(convex_curvature(at, Vec3::UnitZ(), Vec3::UnitX()), 0.05, 1e-12);
    EXPECT_NEAR(convex_curvature(at, Vec3::UnitZ(), Vec3::UnitY()), -0.02, 1e-12);
}

} // namespace
} // namespace millwright::toolpath
