#include "ui/panels/path_series.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::panels {
namespace {

using toolpath::MoveKind;

/// Three moves of 10, 4 and 6 mm; the second goes from track to track.
project::Evaluation three_moves() {
    project::Evaluation evaluation{{grid::Grid::uniform(2, 2)}, {}, {}, {}, {}, {}, {}, {}};
    evaluation.field.moves = {{.kind = MoveKind::track, .closest = 0.1, .length = 10.0},
                              {.kind = MoveKind::cross, .closest = 9.0, .length = 4.0},
                              {.kind = MoveKind::track, .closest = 0.3, .length = 6.0}};
    return evaluation;
}

TEST(PathSeries, StandsInTheMiddleOfEachMoveAndLeavesOutTheWayFromTrackToTrack) {
    const ErrorOverPath series = error_over_path(three_moves());
    EXPECT_EQ(series.at, (std::vector<double>{5.0, 12.0, 17.0}));
    EXPECT_EQ(series.error[0], 0.1);
    EXPECT_TRUE(std::isnan(series.error[1]));
    EXPECT_EQ(series.error[2], 0.3);
}

TEST(PathSeries, MeasuresTheWayUpToAPlaceInAMove) {
    EXPECT_EQ(length_before(three_moves(), -1, 0.5), 0.0);
    EXPECT_EQ(length_before(three_moves(), 0, 0.5), 5.0);
    EXPECT_EQ(length_before(three_moves(), 2, 0.5), 17.0);
    EXPECT_EQ(length_before(three_moves(), 3, 0.0), 20.0);
}

} // namespace
} // namespace millwright::panels
