#include "core/grid/chain_optimiser.h"

#include "core/base/error.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <stop_token>

namespace millwright::grid {
namespace {

constexpr TrackDirection along_v = TrackDirection::along_v;

/// Small enough for tests.
ChainSettings small() {
    ChainSettings settings;
    settings.tracks.lattice = 60;
    settings.tracks.polish_sweeps = 3;
    settings.tracks.gap_allowance = 2.0; // the models' gap is between nodes of equal number
    settings.candidates_a_gap = 4;
    settings.first_descent = 20;
    settings.later_descents = 10;
    return settings;
}

TEST(ChainOptimiser, EachLinkCutsTheErrorOfASpike) {
    const SpikeErrorModel model({.width = 0.02});
    ChainOptimiser chain(model, Grid::uniform(12, 15), along_v, small());
    const ImproverState state = run(chain, {});
    EXPECT_LT(state.of_best.mean, 0.85 * state.start.mean);
    EXPECT_LT(state.of_best.max, 0.3 * state.start.max);
    EXPECT_EQ(state.status, ImproverStatus::converged);
    ASSERT_EQ(chain.links().size(), 7U); // start, track optimiser, chosen tracks, exponents 2, 4, 8, 16
    EXPECT_LT(chain.links()[1].reached.max, chain.links()[0].reached.max);
    EXPECT_LT(chain.links()[2].reached.max, chain.links()[0].reached.max);
    EXPECT_LT(chain.links()[3].reached.lmean, chain.links()[2].reached.lmean);
    EXPECT_LT(chain.links()[6].reached.max, chain.links()[3].reached.max);
}

TEST(ChainOptimiser, NeverReportsAGridThatBreaksThePromise) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const test::RandomErrorModel model(seed, true);
        const Grid start = Grid::uniform(5, 6);
        ChainSettings settings = small();
        settings.first_descent = settings.later_descents = 3;
        ChainOptimiser chain(model, start, along_v, settings);
        const ImproverState state = run(chain, {});
        const ErrorSummary was = summary(measure(model, start, along_v, fine));
        const ErrorSummary is = summary(measure(model, state.best, along_v, fine));
        EXPECT_LE(is.max, was.max + 1e-6);
        EXPECT_LE(is.mean, was.mean + 1e-6);
        EXPECT_LE(is.axis_max, was.axis_max + 1e-8);
        EXPECT_LE(model.track_gap(state.best, along_v), 3.0 * model.track_gap(start, along_v));
        EXPECT_GE(state.best.min_jacobian(), settings.least_jacobian);
    }
}

TEST(ChainOptimiser, CancelledItStandsWhereItStood) {
    const SpikeErrorModel model({});
    ChainOptimiser chain(model, Grid::uniform(8, 9), along_v, small());
    chain.advance({});
    chain.advance({});
    const ImproverState before = chain.state();
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(chain.advance(Progress([](const Progress::Report&) {}, stop.get_token())), Cancelled);
    EXPECT_EQ(chain.state().best, before.best);
    EXPECT_EQ(chain.state().iteration, before.iteration);
    const ImproverState after = run(chain, {});
    EXPECT_LE(after.of_best.max, before.of_best.max);
}

TEST(ChainOptimiser, RefusesSettingsThatMakeNoSense) {
    const SpikeErrorModel model({});
    const auto refused = [&](auto change) {
        ChainSettings settings = small();
        change(settings);
        EXPECT_THROW(ChainOptimiser(model, Grid::uniform(5, 5), along_v, settings), Defect);
    };
    refused([](ChainSettings& s) { s.candidates_a_gap = 0; });
    refused([](ChainSettings& s) { s.widest_gap = 0.9; });
    refused([](ChainSettings& s) { s.narrowest_gap = 1.1; });
    refused([](ChainSettings& s) { s.exponents = {0.0}; });
    refused([](ChainSettings& s) { s.first_descent = -1; });
    refused([](ChainSettings& s) { s.tracks.polish_sweeps = -1; });
}

} // namespace
} // namespace millwright::grid
