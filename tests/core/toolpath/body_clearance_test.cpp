#include "core/toolpath/body_clearance.h"

#include "core/base/error.h"
#include "core/geometry/closest_point.h"
#include "tests/core/toolpath/leans.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace millwright::toolpath {
namespace {

using geometry::ToolPose;
using test::leaning;

/// A square of 80 mm at height 0.
geometry::BezierPatch plane_of_80_mm() {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {80.0 * i - 40.0, 80.0 * j - 40.0, 0.0};
        }
    }
    return geometry::BezierPatch(net);
}

TEST(BodyClearance, OverAPlaneIsTheHeightOfTheLowestPointOfTheBody) {
    std::mt19937 random(8);
    const geometry::BezierPatch patch = plane_of_80_mm();
    for (const CutterShape& shape : test::every_cutter) {
        for (const double angle : {0.05, 0.3, 0.8}) {
            const ToolPose pose{Vec3(3.0, -2.0, 5.0), leaning(random, Vec3::UnitZ(), angle)};
            double lowest = std::numeric_limits<double>::infinity();
            for (const Vec3& p : test::surface_points(shape, pose.axis, 300, 720)) {
                lowest = std::min(lowest, (pose.tip + p).z());
            }
            const BodyClearance found = clearance_near(patch, test::body(shape), pose, {0.5, 0.5});
            EXPECT_NEAR(found.distance, lowest, 1e-3);
        }
    }
}

TEST(BodyClearance, BelowAPlaneIsTheDepthOfTheLowestPointOfTheRim) {
    std::mt19937 random(12);
    const geometry::BezierPatch patch = plane_of_80_mm();
    for (const CutterShape& shape : {test::flat_end, test::bull_nose}) {
        for (const double angle : {0.02, 0.1, 0.4}) {
            const ToolPose pose{Vec3(3.0, -2.0, 0.5 * std::sin(angle)),
                                leaning(random, Vec3::UnitZ(), angle)};
            double lowest = 0.0;
            for (const Vec3& p : test::surface_points(shape, pose.axis, 300, 1440)) {
                lowest = std::min(lowest, (pose.tip + p).z());
            }
            const BodyClearance found = clearance_near(patch, test::body(shape), pose, {0.53, 0.47});
            EXPECT_LT(lowest, -0.02);
            EXPECT_NEAR(found.distance, lowest, 1e-4) << angle;
        }
    }
}

/// A flat that stands square in a valley of the radius R touches with its middle, and bites with its rim.
TEST(BodyClearance, OfAFlatInAValleyIsTheBiteOfItsRim) {
    constexpr double R = 30.0, r = 5.0;
    const double s = std::sqrt(0.5); // the quarter of a circle as a rational quadratic
    geometry::ControlNet net = geometry::ControlNet::sized(2, 3);
    for (int i = 0; i < 2; ++i) {
        const double x = 80.0 * i - 40.0;
        net.point(i, 0) = {x, -R * s, -R * s};
        net.point(i, 1) = {x, 0.0, -R / s};
        net.point(i, 2) = {x, R * s, -R * s};
        net.weight(i, 1) = s;
    }
    const geometry::BezierPatch valley(net);
    const Profile flat = test::body(test::flat_end);
    const ToolPose square{Vec3(0.0, 0.0, -R), Vec3::UnitZ()};
    EXPECT_NEAR(clearance_near(valley, flat, square, {0.5, 0.5}).distance, R - std::hypot(R, r), 1e-6);
    const ToolPose clear{Vec3(0.0, 0.0, -R + 1.0), Vec3::UnitZ()};
    EXPECT_GT(clearance_near(valley, flat, clear, {0.5, 0.5}).distance, 0.0);
}

/// Where the rim hangs over the edge of the patch there is nothing that it could bite.
TEST(BodyClearance, OfARimBeyondTheEdgeIsNoBite) {
    const Profile flat = test::body(test::flat_end);
    const double lean = 0.1;
    const ToolPose at_edge{Vec3(40.0 + 5.0, 0.0, 0.3), Vec3(std::sin(lean), 0.0, std::cos(lean))};
    EXPECT_GT(clearance_near(plane_of_80_mm(), flat, at_edge, {1.0, 0.5}).distance, 0.0);
}

TEST(BodyClearance, OfABallIsThatOfItsCentre) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> parameter(0.1, 0.9);
    for (const auto* preset : {"dome", "two-bell", "saddle"}) {
        const auto patch = test::patch(preset);
        const geometry::ClosestPointSearch search(patch);
        for (int n = 0; n < 100; ++n) {
            const Vec2 uv(parameter(random), parameter(random));
            const Vec3 normal = patch.unit_normal(uv.x(), uv.y()).value();
            const Vec3 axis = leaning(random, normal, 0.3);
            const double off = 0.04 * n - 3.5; // from half a millimetre of the centre above the surface
            const ToolPose pose{patch.position(uv.x(), uv.y()) + (4.0 + off) * normal - 4.0 * axis, axis};
            const geometry::ClosestPoint foot = search.closest(pose.tip + 4.0 * axis, uv);
            const Vec3 up = patch.unit_normal(foot.parameters.x(), foot.parameters.y()).value();
            const double reference = (pose.tip + 4.0 * axis - foot.position).dot(up) - 4.0;
            const BodyClearance found = clearance_near(patch, test::body(test::ball), pose, uv);
            EXPECT_NEAR(found.distance, reference, 1e-9) << preset << ", " << uv.transpose();
        }
    }
}

/// Nothing on a fine raster around is nearer, and the point found is as near as it says.
TEST(BodyClearance, OfEveryCutterIsTheLeastOfARaster) {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> parameter(0.2, 0.8);
    const auto patch = test::patch("two-bell");
    for (const CutterShape& shape : test::every_cutter) {
        const Profile body = test::body(shape);
        for (int n = 0; n < 20; ++n) {
            const Vec2 uv(parameter(random), parameter(random));
            const Vec3 normal = patch.unit_normal(uv.x(), uv.y()).value();
            const Vec3 axis = leaning(random, normal, 0.25);
            const Vec3 contact = patch.position(uv.x(), uv.y()) + 0.05 * normal;
            const ToolPose pose{tip_for(body, contact, normal, axis), axis};
            const BodyClearance found = clearance_near(patch, body, pose, uv);
            const Vec3 at = patch.position(found.parameters.x(), found.parameters.y());
            const double least_distance = distance(body, pose, at);
            if (found.distance >= 0.0) {
                EXPECT_NEAR(least_distance, found.distance, 1e-12);
            }
            double least = std::numeric_limits<double>::infinity();
            for (int i = -40; i <= 40; ++i) {
                for (int j = -40; j <= 40; ++j) {
                    const Vec2 near = found.parameters + 0.0004 * Vec2(i, j);
                    least = std::min(least, distance(body, pose, patch.position(near.x(), near.y())));
                }
            }
            EXPECT_GE(least, least_distance - 1e-9);
        }
    }
}

TEST(BodyClearance, StaysOnThePatchAndRefusesWhatIsNotFinite) {
    const ToolPose beside{Vec3(45.0, 0.0, 1.0), Vec3::UnitZ()};
    const BodyClearance found = clearance_near(plane_of_80_mm(), test::body(test::ball), beside, {0.5, 0.5});
    EXPECT_EQ(found.parameters.x(), 1.0);
    EXPECT_NEAR(found.distance, std::hypot(5.0, 5.0) - 4.0, 1e-9);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)clearance_near(
                     plane_of_80_mm(), test::body(test::ball), {Vec3(nan, 0, 0), Vec3::UnitZ()}, {0, 0}),
                 Defect);
}

} // namespace
} // namespace millwright::toolpath
