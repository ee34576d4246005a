#include "core/toolpath/spiral.h"

#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

namespace millwright::toolpath {
namespace {

using grid::TrackDirection;

const std::vector<std::pair<int, int>> sizes{{2, 2}, {2, 7}, {7, 2}, {3, 3}, {4, 5}, {6, 6}, {9, 4}};

TEST(Spiral, VisitsEveryNodeOnceFromNeighbourToNeighbour) {
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        for (const auto& [nu, nv] : sizes) {
            const auto order = spiral_order(nu, nv, direction);
            EXPECT_EQ(std::ssize(order), nu * nv);
            EXPECT_EQ(std::set(order.begin(), order.end()).size(), order.size()) << nu << " x " << nv;
            for (std::size_t n = 1; n < order.size(); ++n) {
                EXPECT_EQ(std::abs(order[n][0] - order[n - 1][0]) + std::abs(order[n][1] - order[n - 1][1]),
                          1);
            }
            const bool along_v = direction == TrackDirection::along_v;
            EXPECT_EQ(order[1], (along_v ? std::array{0, 1} : std::array{1, 0}));
        }
    }
}

TEST(Spiral, IsOneCutOverTheNodesOfTheGrid) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("ac-table");
    const grid::Grid grid = grid::Grid::uniform(5, 6);
    const Tool point;
    const Toolpath path = Spiral().contacts({patch, machine, point, grid, TrackDirection::along_v, true}, {});
    ASSERT_EQ(path.points.size(), 30U);
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const PathPoint& there = path.points[n];
        EXPECT_EQ(there.reached_by, n == 0 ? MoveKind::start : MoveKind::track);
        EXPECT_EQ(there.origin.uv, grid.node(there.origin.i, there.origin.j));
        EXPECT_EQ(there.contact, patch.position(there.origin.uv.x(), there.origin.uv.y()));
        EXPECT_LT(there.normal.z(), 0.0); // flipped
    }
}

} // namespace
} // namespace millwright::toolpath
