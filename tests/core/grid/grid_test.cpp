#include "core/grid/grid.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::grid {
namespace {

// T3.
TEST(Grid, UniformHasEqualCellsAndExactEdges) {
    const Grid grid = Grid::uniform(20, 7);
    EXPECT_EQ(grid.nu(), 20);
    EXPECT_EQ(grid.nv(), 7);
    EXPECT_EQ(grid.node(0, 0), Vec2(0.0, 0.0));
    EXPECT_EQ(grid.node(19, 6), Vec2(1.0, 1.0));
    EXPECT_NEAR(grid.node(3, 2).x(), 3.0 / 19.0, 1e-15);
    EXPECT_NEAR(grid.node(3, 2).y(), 2.0 / 6.0, 1e-15);
    EXPECT_NEAR(grid.min_jacobian(), 1.0, 1e-12);
}

TEST(Grid, TracksFollowRowsAlongVAndColumnsAlongU) {
    const Grid grid = Grid::uniform(4, 6);
    EXPECT_EQ(grid.track_count(TrackDirection::along_v), 4);
    EXPECT_EQ(grid.nodes_per_track(TrackDirection::along_v), 6);
    EXPECT_EQ(grid.track_node(TrackDirection::along_v, 2, 5), grid.node(2, 5));
    EXPECT_EQ(grid.track_count(TrackDirection::along_u), 6);
    EXPECT_EQ(grid.nodes_per_track(TrackDirection::along_u), 4);
    EXPECT_EQ(grid.track_node(TrackDirection::along_u, 5, 2), grid.node(2, 5));
}

TEST(Grid, CannotExistFoldedOutsideOrNotFinite) {
    const NodeArray good = Grid::uniform(4, 4).array();
    const auto with = [&](int i, int j, Vec2 p) {
        NodeArray array = good;
        array.at(i, j) = p;
        return array;
    };
    EXPECT_NO_THROW((void)Grid(good));
    EXPECT_THROW((void)Grid(with(1, 1, {0.9, 0.9})), Defect);
    EXPECT_THROW((void)Grid(with(0, 1, {-0.01, 0.3})), Defect);
    EXPECT_THROW((void)Grid(with(1, 1, {std::numeric_limits<double>::quiet_NaN(), 0.3})), Defect);
    EXPECT_THROW((void)Grid(NodeArray(1, 4)), Defect);
    EXPECT_THROW((void)Grid::uniform(20, 1), Defect);
}

} // namespace
} // namespace millwright::grid
