#include "ui/panels/watched_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

using grid::OptimiserStatus;
using testing::HasSubstr;

grid::OptimiserState state(OptimiserStatus status, double now, double best) {
    grid::OptimiserState state{.current = {}, .best = grid::Grid::uniform(2, 2)};
    state.status = status;
    state.now.mean = now;
    state.of_best.mean = best;
    return state;
}

TEST(WatchedText, CallsNothingKeptWhileItRuns) {
    EXPECT_EQ(watched_labels(OptimiserStatus::running).best, "Best so far");
    EXPECT_EQ(watched_labels(OptimiserStatus::running).change, "Change so far");
    EXPECT_THAT(watched_note(state(OptimiserStatus::running, 0.7, 0.67)), HasSubstr("not final"));
    EXPECT_EQ(watched_labels(OptimiserStatus::converged).best, "Mean error, kept");
}

TEST(WatchedText, SaysAtTheEndWhyAGridWithLessErrorIsNotKept) {
    EXPECT_THAT(watched_note(state(OptimiserStatus::no_gain, 0.6, 0.7)), HasSubstr("is not kept"));
    EXPECT_EQ(watched_note(state(OptimiserStatus::converged, 0.7, 0.7)), "");
}

} // namespace
} // namespace millwright::panels
