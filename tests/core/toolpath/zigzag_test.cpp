#include "core/toolpath/zigzag.h"

#include "core/base/error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <set>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

class Zigzag : public ::testing::TestWithParam<std::tuple<int, int, TrackDirection>> {};

// T3, T7.
TEST_P(Zigzag, VisitsEveryNodeOnceInUnitStepsOfTheGrid) {
    const auto [nu, nv, direction] = GetParam();
    const Toolpath path = zigzag(test::patch("dome"), Grid::uniform(nu, nv), direction, false);
    ASSERT_EQ(std::ssize(path.points), nu * nv);
    std::set<std::pair<int, int>> visited;
    int cross_moves = 0;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const GridOrigin& at = path.points[n].origin;
        EXPECT_TRUE(visited.insert({at.i, at.j}).second);
        if (n == 0) {
            EXPECT_EQ(path.points[n].reached_by, MoveKind::start);
            continue;
        }
        const GridOrigin& before = path.points[n - 1].origin;
        EXPECT_EQ(std::abs(at.i - before.i) + std::abs(at.j - before.j), 1);
        const bool across = direction == TrackDirection::along_v ? at.i != before.i : at.j != before.j;
        EXPECT_EQ(path.points[n].reached_by, across ? MoveKind::cross : MoveKind::track);
        cross_moves += across ? 1 : 0;
    }
    EXPECT_EQ(cross_moves, (direction == TrackDirection::along_v ? nu : nv) - 1);
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         Zigzag,
                         ::testing::Combine(::testing::Values(2, 3, 20),
                                            ::testing::Values(2, 5, 20),
                                            ::testing::Values(TrackDirection::along_u,
                                                              TrackDirection::along_v)));

// T7.
TEST(ZigzagPoses, LieOnTheSurfaceWithTheToolAlongTheNormal) {
    const auto patch = test::patch("two-bell");
    for (const bool flipped : {false, true}) {
        for (const PathPoint& p :
             zigzag(patch, Grid::uniform(7, 9), TrackDirection::along_u, flipped).points) {
            const Vec2& uv = p.origin.uv;
            EXPECT_EQ(p.pose.tip, patch.position(uv.x(), uv.y()));
            const Vec3 normal = patch.unit_normal(uv.x(), uv.y()).value();
            EXPECT_LT((p.pose.axis - (flipped ? Vec3(-normal) : normal)).norm(), 1e-15);
        }
    }
}

TEST(ZigzagPoses, ADegenerateNormalIsReportedWithItsParameters) {
    geometry::ControlNet net = test::patch("dome").net();
    for (int j = 0; j < 4; ++j) {
        net.point(0, j) = {10, 10, 1};
    }
    try {
        (void)zigzag(geometry::BezierPatch(net), Grid::uniform(4, 4), TrackDirection::along_v, false);
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("u = 0, v = 0"), std::string::npos)
            << error.diagnostic().message;
    }
}

TEST(PathLength, IsTheSumOfTheStraightMoves) {
    Toolpath path;
    path.points.resize(3);
    path.points[1].pose.tip = {3, 4, 0};
    path.points[2].pose.tip = {3, 4, 12};
    EXPECT_DOUBLE_EQ(length(path), 17.0);
}

} // namespace
} // namespace millwright::toolpath
