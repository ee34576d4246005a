#include "core/grid/error_model.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <vector>

namespace millwright::grid {
namespace {

using test::infinity;

TEST(Measure, HasEachTracksMovesInOrder) {
    const SpikeErrorModel model({});
    const Grid grid = Grid::uniform(3, 5);
    const auto moves_along_v = measure(model, grid, TrackDirection::along_v, coarse);
    ASSERT_EQ(moves_along_v.size(), 3U * 4U);
    EXPECT_EQ(moves_along_v[1 * 4 + 2].tip, model.move(grid.node(1, 2), grid.node(1, 3), coarse).tip);
    const auto along_u = measure(model, grid, TrackDirection::along_u, coarse);
    ASSERT_EQ(along_u.size(), 5U * 2U);
    EXPECT_EQ(along_u[4 * 2 + 1].tip, model.move(grid.node(1, 4), grid.node(2, 4), coarse).tip);
}

TEST(Measure, IsTheSameOnAnyNumberOfThreads) {
    const SpikeErrorModel model({});
    const Grid grid = Grid::uniform(9, 9);
    std::vector<ErrorSummary> found;
    for (const int threads : {1, 2, 7}) {
        set_thread_count(threads);
        found.push_back(summary(measure(model, grid, TrackDirection::along_v, coarse)));
    }
    set_thread_count(0);
    EXPECT_EQ(found[0].mean, found[1].mean);
    EXPECT_EQ(found[0].mean, found[2].mean);
}

TEST(Summary, OfThreeMovesIsWhatOneComputesByHand) {
    const std::vector<MoveError> moves{{1.0, 0.1, 3.0}, {2.0, 0.4, 1.0}, {6.0, 0.1, 1.0}};
    const ErrorSummary s = summary(moves);
    EXPECT_DOUBLE_EQ(s.max, 6.0);
    EXPECT_DOUBLE_EQ(s.mean, 3.0);
    EXPECT_DOUBLE_EQ(s.lmean, 11.0 / 5.0);
    EXPECT_DOUBLE_EQ(s.rms, std::sqrt(41.0 / 3.0));
    EXPECT_DOUBLE_EQ(s.variance, 14.0 / 3.0);
    EXPECT_DOUBLE_EQ(s.p95, 6.0);
    EXPECT_DOUBLE_EQ(s.axis_max, 0.4);
    EXPECT_DOUBLE_EQ(s.axis_mean, 0.2);
}

TEST(Summary, LeavesFivePercentAboveP95) {
    std::vector<MoveError> moves;
    for (int k = 100; k > 0; --k) {
        moves.push_back({static_cast<double>(k), 0.0, 1.0});
    }
    EXPECT_DOUBLE_EQ(summary(moves).p95, 95.0);
}

TEST(Summary, OfMovesWithoutLengthWeighsThemEqually) {
    const std::vector<MoveError> moves{{1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
    EXPECT_DOUBLE_EQ(summary(moves).lmean, 2.0);
}

TEST(Summary, OfAMoveOutOfReachIsInfinite) {
    const std::vector<MoveError> moves{{1.0, 0.0, 1.0}, {infinity, infinity, 1.0}};
    const ErrorSummary s = summary(moves);
    EXPECT_EQ(s.mean, infinity);
    EXPECT_EQ(s.p95, infinity);
    EXPECT_EQ(s.axis_mean, infinity);
}

TEST(Summary, NeedsAMove) {
    EXPECT_THROW((void)summary({}), Defect);
}

} // namespace
} // namespace millwright::grid
