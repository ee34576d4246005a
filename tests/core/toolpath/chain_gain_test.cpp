// What the whole chain is for, on real machines: figures of a prototype that it must reach.
#include "core/grid/chain_optimiser.h"
#include "core/grid/fewest_nodes.h"
#include "tests/support/inner_tracks.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <ostream>

namespace millwright::toolpath {
namespace {

using grid::TrackDirection;

struct ChainGainRow {
    int nodes;
    double uniform_max, uniform_mean, max, mean;

    friend std::ostream& operator<<(std::ostream& out, const ChainGainRow& row) { return out << row.nodes; }
};

class ChainGain : public ::testing::TestWithParam<ChainGainRow> {};

// T17.
TEST_P(ChainGain, ReachesThePrototypeOnTheTwoBells) {
    const KinematicError error = test::two_bell_error();
    const grid::Grid start = test::inner_tracks(GetParam().nodes);
    grid::ChainOptimiser chain(error, start, TrackDirection::along_u, {});
    const grid::OptimiserState state = run(chain, {});
    EXPECT_NEAR(state.start.max, GetParam().uniform_max, 0.005);
    EXPECT_NEAR(state.start.mean, GetParam().uniform_mean, 0.0005);
    EXPECT_LE(state.of_best.max, GetParam().max);
    EXPECT_LE(state.of_best.mean, GetParam().mean);
    EXPECT_LE(state.of_best.axis_max, state.start.axis_max);
    EXPECT_LE(error.track_gap(state.best, TrackDirection::along_u),
              1.15 * error.track_gap(start, TrackDirection::along_u));
    EXPECT_GE(state.best.min_jacobian(), 0.015);
}

INSTANTIATE_TEST_SUITE_P(OfTwoBells,
                         ChainGain,
                         ::testing::Values(ChainGainRow{15, 12.37, 1.302, 1.01, 0.441},
                                           ChainGainRow{20, 11.13, 0.827, 0.548, 0.269},
                                           ChainGainRow{40, 7.046, 0.232, 0.155, 0.078}));

/// Few nodes: the tracks that are best for the tip turn the axis further than the uniform grid does.
TEST(ChainGainOfTheDome, PaysTheAxisAtTenNodesWithNextToNothingOfTheMean) {
    const KinematicError error = test::dome_error();
    const grid::Grid start = grid::Grid::uniform(10, 10);
    grid::ChainOptimiser chain(error, start, TrackDirection::along_u, {});
    const grid::OptimiserState state = run(chain, {});
    EXPECT_NEAR(state.start.max, 15.76, 0.005);
    EXPECT_NEAR(state.start.mean, 1.594, 0.0005);
    EXPECT_LE(state.of_best.max, 1.08); // a prototype, which let the axis be, reached 1.21 and 0.640
    EXPECT_LE(state.of_best.mean, 0.645);
    EXPECT_LE(state.of_best.axis_max, state.start.axis_max);
}

/// Between the ridges near its singular point a descent alone comes to rest at 0.378 and 0.187 mm.
TEST(ChainGainOfTheDome, LeapsOverTheRidgesAtTwentyNodes) {
    const KinematicError error = test::dome_error();
    grid::ChainOptimiser chain(error, grid::Grid::uniform(20, 20), TrackDirection::along_u, {});
    const grid::OptimiserState state = run(chain, {});
    EXPECT_LE(state.of_best.max, 0.32); // a prototype reached 0.434 and 0.203
    EXPECT_LE(state.of_best.mean, 0.178);
    EXPECT_LE(state.of_best.axis_max, state.start.axis_max);
}

/// Eight tracks, v = 0.02 ... 0.98: nodes of all of them for a largest error.
int fewest_nodes_of_eight_tracks(double tolerance) {
    constexpr int tracks = 8;
    const KinematicError error = test::two_bell_error();
    std::size_t nodes = 0;
    for (int n = 0; n < tracks; ++n) {
        const grid::Track track{TrackDirection::along_u, 0.02 + 0.96 * n / (tracks - 1)};
        const auto found = fewest_nodes(error, track, 0.0, 1.0, {.tip = tolerance}, {}, {});
        EXPECT_TRUE(found.has_value());
        nodes += found ? found->places.size() : 0;
    }
    return static_cast<int>(nodes);
}

TEST(ChainGainByTolerance, NeedsNotOneNodeMoreThanThePrototype) {
    EXPECT_LE(fewest_nodes_of_eight_tracks(0.1), 334);
    EXPECT_LE(fewest_nodes_of_eight_tracks(0.05), 466);
}

} // namespace
} // namespace millwright::toolpath
