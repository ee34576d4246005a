#include "core/base/error.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;
using ::testing::HasSubstr;

struct Made {
    kinematics::MachineModel machine = test::machine("rotary-tilt-listing");
    Toolpath path;
    AxisPath axes;

    explicit Made(TrackDirection direction)
        : path(zigzag(test::patch("dome"), Grid::uniform(6, 5), direction, false)),
          axes(sequence(machine, path)) {}
    [[nodiscard]] Vec3 middle(std::size_t move) const {
        return actual_pose(machine, axes.positions[move], axes.positions[move + 1], 0.5).tip;
    }
};

// Eqs 10 and 11: T is the middle of each move, and straight from track to track.
TEST(ProducedSurface, HasTheMiddlesOfTheMovesOnTracksThatAllGoTheSameWay) {
    for (const auto direction : {TrackDirection::along_v, TrackDirection::along_u}) {
        const Made made(direction);
        const auto surface = produced_surface(made.machine, made.path, made.axes, 2);
        ASSERT_TRUE(surface);
        const int tracks = direction == TrackDirection::along_v ? 6 : 5;
        const int moves = (direction == TrackDirection::along_v ? 5 : 6) - 1;
        ASSERT_EQ(surface->tracks, tracks);
        ASSERT_EQ(surface->places, 2 * moves + 1);
        const auto first_of_second = static_cast<std::size_t>(moves + 1);
        EXPECT_LT((surface->at(0, 1) - made.middle(0)).norm(), 1e-9);
        // The second track was cut backwards: its first move is the last one in the parameters.
        EXPECT_LT((surface->at(1, 2 * moves - 1) - made.middle(first_of_second)).norm(), 1e-9);
        // Nodes are on the designed surface.
        EXPECT_LT((surface->at(0, 0) - made.path.points[0].pose.tip).norm(), 1e-9);
        EXPECT_LT((surface->at(1, 0) - made.path.points[2 * first_of_second - 1].pose.tip).norm(), 1e-9);
    }
}

TEST(ProducedSurface, IsNoneWhereNoTracksLieSideBySideAndSaysWhy) {
    const Made made(TrackDirection::along_v);
    EXPECT_EQ(why_no_produced_surface(made.path), "");
    Toolpath longer = made.path;
    AxisPath axes = made.axes;
    longer.points.push_back(longer.points.back()); // one more move on the last track
    axes.positions.push_back(axes.positions.back());
    EXPECT_FALSE(produced_surface(made.machine, longer, axes, 2));
    EXPECT_THAT(why_no_produced_surface(longer), HasSubstr("parallel tracks with equal numbers of points"));
    Toolpath lifted = made.path;
    lifted.points[3].reached_by = MoveKind::over;
    EXPECT_FALSE(produced_surface(made.machine, lifted, made.axes, 2));
    EXPECT_THAT(why_no_produced_surface(lifted), HasSubstr("lifts over parts"));
    Toolpath with_cutter = made.path;
    with_cutter.tool.cutter = test::body({.kind = CutterKind::ball, .diameter = 6.0, .length = 30.0});
    EXPECT_FALSE(produced_surface(made.machine, with_cutter, made.axes, 2));
    EXPECT_THAT(why_no_produced_surface(with_cutter), HasSubstr("a point tool"));
    EXPECT_FALSE(produced_surface(made.machine, {}, {}, 2));
    EXPECT_NE(why_no_produced_surface({}), "");
    EXPECT_THROW((void)produced_surface(made.machine, made.path, made.axes, 0), Defect);
}

} // namespace
} // namespace millwright::toolpath
