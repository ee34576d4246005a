#include "core/toolpath/lean.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

TEST(Lean, LeadsForwardAndTiltsToTheRight) {
    const Vec3 up = Vec3::UnitZ();
    const Vec3 north = Vec3::UnitY();
    const Vec3 east = Vec3::UnitX(); // right of who goes north
    const Vec3 lead = leaning_axis({.lead = 0.3}, up, north, 0.0);
    EXPECT_LT((lead - (std::cos(0.3) * up + std::sin(0.3) * north)).norm(), 1e-15);
    const Vec3 tilt = leaning_axis({.tilt = 0.3}, up, north, 0.0);
    EXPECT_LT((tilt - (std::cos(0.3) * up + std::sin(0.3) * east)).norm(), 1e-15);
    const Vec3 both = leaning_axis({.lead = 0.3, .tilt = -0.5}, up, north, 0.0);
    EXPECT_NEAR(both.dot(up), std::cos(0.3) * std::cos(0.5), 1e-15);
    EXPECT_NEAR(std::asin(both.dot(north)), 0.3, 1e-15);
    EXPECT_LT(both.dot(east), 0.0);
}

TEST(Lean, ChangesLinearlyAlongTheTrack) {
    const Lean lean{.lead = 0.1, .tilt = 0.2, .lead_change = 0.4, .tilt_change = -0.2};
    const Vec3 axis = leaning_axis(lean, Vec3::UnitZ(), Vec3::UnitX(), 0.25);
    EXPECT_NEAR(std::asin(axis.x()), 0.2, 1e-15);
    EXPECT_NEAR(std::atan2(-axis.y(), axis.z()), 0.15, 1e-15);
}

/// On a path both angles are those asked for, against the normal and the direction in which the tool goes.
TEST(Lean, HoldsItsAnglesOnEveryTrackOfAZigzag) {
    const auto patch = test::patch("two-bell");
    const Lean lean{.lead = from_degrees(10.0), .tilt = from_degrees(-5.0), .lead_change = from_degrees(6.0)};
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const Toolpath path = leaned(patch, lean, zigzag(patch, Grid::uniform(6, 8), direction, false));
        for (std::size_t n = 1; n < path.points.size(); ++n) {
            const PathPoint& point = path.points[n];
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

TEST(Lean, ATrackWithoutDirectionIsReportedWithItsNode) {
    const auto patch = test::patch("dome");
    Toolpath path = zigzag(patch, Grid::uniform(2, 2), TrackDirection::along_v, false);
    path.points[3].origin.uv = path.points[2].origin.uv;
    try {
        (void)leaned(patch, {.lead = 0.1}, path);
        FAIL() << "a track that stands still";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("node 1,1"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW((void)leaned(patch, {}, path));
}

} // namespace
} // namespace millwright::toolpath
