#include "core/toolpath/tool_poses.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/internal/tool_curve.h"
#include "core/toolpath/zigzag.h"
#include "tests/core/toolpath/leans.h"
#include "tests/support/cutters.h"
#include "tests/support/lens_face.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;
using test::ten_degrees;

/// On a path both angles are those asked for, against the normal and the direction in which the tool goes.
TEST(ToolPoses, HoldTheirAnglesOnEveryTrackOfAZigzag) {
    const auto patch = test::patch("two-bell");
    const auto machine = test::machine("ac-table");
    const Tool tool{
        .lean = {.lead = from_degrees(10.0), .tilt = from_degrees(-5.0), .lead_change = from_degrees(6.0)}};
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const Toolpath path =
            with_tool(patch, machine, tool, zigzag(patch, Grid::uniform(6, 8), direction, false));
        for (const PathPoint& point : path.points) {
            const Vec2& uv = point.origin.uv;
            const auto at = patch.derivatives(uv.x(), uv.y());
            const bool along_v = direction == TrackDirection::along_v;
            const bool backwards = (along_v ? point.origin.i : point.origin.j) % 2 == 1;
            const Vec3 feed = (backwards ? -1.0 : 1.0) * (along_v ? at.dv : at.du).normalized();
            EXPECT_NEAR(point.pose.axis.dot(feed),
                        std::sin(from_degrees(10.0 + 6.0 * (along_v ? uv.y() : uv.x()))),
                        1e-12);
            const double tilt =
                std::atan2(point.pose.axis.dot(feed.cross(point.normal)), point.pose.axis.dot(point.normal));
            EXPECT_NEAR(to_degrees(tilt), -5.0, 1e-9);
            EXPECT_EQ(point.contact, point.pose.tip);
        }
    }
}

TEST(ToolPoses, ThePathOfAPointIsLeftAsItIs) {
    const auto patch = test::patch("dome");
    const Toolpath path = zigzag(patch, Grid::uniform(5, 6), TrackDirection::along_v, false);
    const Toolpath same = with_tool(patch, test::machine("ac-table"), {}, path);
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        EXPECT_EQ(same.points[n].pose.tip, path.points[n].pose.tip);
        EXPECT_EQ(same.points[n].pose.axis, path.points[n].pose.axis);
    }
}

TEST(ToolPoses, EveryCutterTouchesItsContactAndNothingNearItIsCut) {
    const auto patch = test::patch("dome");
    for (const CutterShape& shape : test::every_cutter) {
        for (const char* machine : {"ac-table", "router-xyz"}) {
            const Tool tool{.cutter = test::body(shape), .lean = ten_degrees};
            const Toolpath path =
                with_tool(patch,
                          test::machine(machine),
                          tool,
                          zigzag(patch, Grid::uniform(5, 6), TrackDirection::along_v, false));
            for (const PathPoint& point : path.points) {
                EXPECT_NEAR(distance(*tool.cutter, point.pose, point.contact), 0.0, 1e-9);
                const Vec3 inside = point.contact - 0.05 * point.normal;
                EXPECT_GT(distance(*tool.cutter, point.pose, inside), 0.04);
            }
        }
    }
}

// It had none, and the error of the moves there was not looked at.
TEST(ToolPlace, HasAPoseWhereASideOfTheSurfaceIsAPoint) {
    const geometry::BsplineSurface lens(test::lens_net());
    const auto machine = test::machine("ac-table");
    for (const CutterShape& shape : test::every_cutter) {
        for (const double u : {0.0, 1.0}) {
            const double near = u > 0.5 ? 1.0 - 1e-7 : 1e-7;
            const Tool tool{.cutter = test::body(shape)};
            const ToolPlace at_tip = tool_place(lens, machine, false, tool, {u, 0.3}, Vec2::UnitX());
            const ToolPlace beside = tool_place(lens, machine, false, tool, {near, 0.3}, Vec2::UnitX());
            ASSERT_TRUE(at_tip.pose && beside.pose);
            EXPECT_LT((at_tip.normal - beside.normal).norm(), 1e-5);
            EXPECT_LT((at_tip.pose->tip - beside.pose->tip).norm(), 1e-4);
        }
    }
}

TEST(ToolPoses, ATrackWithoutDirectionIsReportedWithItsNode) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("ac-table");
    Toolpath path = zigzag(patch, Grid::uniform(2, 2), TrackDirection::along_v, false);
    path.points[3].origin.uv = path.points[2].origin.uv;
    try {
        (void)with_tool(patch, machine, {.lean = ten_degrees}, path);
        FAIL() << "a track that stands still";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("node 1,1"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW((void)with_tool(patch, machine, {}, path));
}

} // namespace
} // namespace millwright::toolpath
