#include "core/grid/track.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright::grid {
namespace {

TEST(StraightTracks, GiveBackTheGridBitForBit) {
    NodeArray nodes = Grid::uniform(4, 7).array();
    for (int i = 0; i < 4; ++i) {
        nodes.at(i, 3).y() += 0.01 * i; // slides along v
    }
    const Grid grid(nodes);
    EXPECT_EQ(array_of(straight_tracks(grid, TrackDirection::along_v)), nodes);
    const Grid uniform = Grid::uniform(5, 3);
    EXPECT_EQ(array_of(straight_tracks(uniform, TrackDirection::along_u)), uniform.array());
}

TEST(StraightTracks, RunAlongTheirDirection) {
    const auto tracks = straight_tracks(Grid::uniform(3, 5), TrackDirection::along_u);
    ASSERT_EQ(tracks.size(), 5U);
    EXPECT_EQ(tracks[1].track.across, 0.25);
    EXPECT_EQ(tracks[1].places, (std::vector<double>{0.0, 0.5, 1.0}));
    EXPECT_EQ(tracks[1].track.at(0.3), Vec2(0.3, 0.25));
}

TEST(StraightTracks, OfABentGridAreADefect) {
    NodeArray nodes = Grid::uniform(4, 4).array();
    nodes.at(1, 1).x() += 0.01;
    EXPECT_THROW((void)straight_tracks(Grid(nodes), TrackDirection::along_v), Defect);
}

} // namespace
} // namespace millwright::grid
