#include "core/grid/redistribution.h"

#include "core/base/error.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace millwright::grid {
namespace {

using test::along_v;

OptimiserState
redistributed(const ErrorModel& model, const Grid& start, RedistributionSettings settings = {}) {
    settings.gap_allowance = 2.0; // the models' gap is between nodes of equal number
    Redistribution redistribution(model, start, along_v, settings);
    return run(redistribution, {});
}

TEST(Redistribution, CutsTheErrorOfASpikeThatMovesCanSee) {
    const SpikeErrorModel model({.width = 0.1});
    const OptimiserState state = redistributed(model, Grid::uniform(12, 20));
    EXPECT_EQ(state.status, OptimiserStatus::converged);
    EXPECT_LT(state.of_best.mean, 0.98 * state.start.mean);
    EXPECT_LT(state.of_best.max, state.start.max);
    EXPECT_GT(state.best.min_jacobian(), 0.0);
}

TEST(Redistribution, HasAMonitorOfMeanOneThatIsLargeAtTheSpike) {
    const SpikeErrorModel model({.width = 0.1});
    const PlacedTrack track = straight_tracks(Grid::uniform(3, 20), along_v)[1];
    const std::vector<double> found = step_monitor(model, track, 152, {});
    EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0) / 152.0, 1.0, 1e-12);
    EXPECT_GT(*std::ranges::max_element(found), 1.5);
    EXPECT_GE(*std::ranges::min_element(found), 0.0);
}

TEST(Redistribution, IsNeverWorseThanTheStart) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::RandomErrorModel model(seed);
        const OptimiserState state = redistributed(model, Grid::uniform(6, 9));
        EXPECT_LE(state.of_best.mean, state.start.mean);
        EXPECT_LE(state.of_best.max, state.start.max);
        EXPECT_LE(state.of_best.axis_max, state.start.axis_max);
    }
}

TEST(Redistribution, RefusesSettingsWithoutSense) {
    const SpikeErrorModel model({});
    EXPECT_THROW(Redistribution(model, Grid::uniform(4, 4), along_v, {.floor = 0.0}), Defect);
}

} // namespace
} // namespace millwright::grid
