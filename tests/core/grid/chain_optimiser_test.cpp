#include "core/grid/chain_optimiser.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/closed_form_error_model.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <string_view>

namespace millwright::grid {
namespace {

using test::along_v;

/// Small enough for tests.
ChainSettings small_chain() {
    ChainSettings settings;
    settings.tracks.lattice = 60;
    settings.tracks.polish_sweeps = 3;
    settings.tracks.gap_allowance = 2.0; // the models' gap is between nodes of equal number
    settings.candidates_per_gap = 4;
    settings.first_descent = 20;
    settings.later_descents = 10;
    return settings;
}

TEST(ChainOptimiser, EachLinkCutsTheErrorOfASpike) {
    const SpikeErrorModel model({.width = 0.02});
    ChainOptimiser chain(model, Grid::uniform(12, 15), along_v, small_chain());
    const OptimiserState state = run(chain, {});
    EXPECT_LT(state.of_best.mean, 0.85 * state.start.mean);
    EXPECT_LT(state.of_best.max, 0.3 * state.start.max);
    EXPECT_EQ(state.status, OptimiserStatus::converged);
    // start, track optimiser, chosen tracks, exponents 2, 4, 6, 8, 16, 32
    ASSERT_EQ(state.stages.size(), 9U);
    EXPECT_LT(state.stages[1].reached.max, state.stages[0].reached.max);
    EXPECT_LT(state.stages[2].reached.max, state.stages[0].reached.max);
    EXPECT_LT(state.stages[3].reached.lmean, state.stages[2].reached.lmean);
    EXPECT_LT(state.stages[8].reached.max, state.stages[3].reached.max);
}

/// A spike whose error is smaller between the tracks of a start than on them, where the tool axis turns more.
class TwistedErrorModel final : public ClosedFormErrorModel {
public:
    explicit TwistedErrorModel(int gaps) : gaps_(gaps) {}

    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const override {
        const double between = square(std::sin(pi * gaps_ * 0.5 * (a.x() + b.x())));
        MoveError found = spike_.move(a, b, sampling);
        found.tip *= 1.0 - 0.5 * between;
        found.axis *= 1.0 + 3.0 * between;
        return found;
    }

private:
    SpikeErrorModel spike_{{.width = 0.02}};
    int gaps_;
};

bool has_stage(const OptimiserState& state, std::string_view name, bool accepted) {
    return std::ranges::any_of(state.stages, [&](const ChainStage& stage) {
        return stage.name == name && stage.refused.empty() == accepted;
    });
}

TEST(ChainOptimiser, PricesTheAxisWhereTheBestTracksTurnItTooFar) {
    const TwistedErrorModel model(7);
    ChainSettings settings = small_chain();
    settings.candidates_per_gap = 8;
    ChainOptimiser chain(model, Grid::uniform(8, 12), along_v, settings);
    const OptimiserState state = run(chain, {});
    EXPECT_TRUE(has_stage(state, "best tracks and nodes", false));
    EXPECT_TRUE(has_stage(state, "best tracks and nodes, with axis weight", true));
    EXPECT_EQ(state.stages.size(), 10U);
    EXPECT_LE(state.of_best.axis_max, state.start.axis_max + 1e-8);
    EXPECT_LT(state.of_best.mean, 0.9 * state.start.mean);
}

TEST(ChainOptimiser, EndsWithTheNameOfTheLinkWhoseGridIsKept) {
    const SpikeErrorModel model({.width = 0.02});
    ChainSettings settings = small_chain();
    settings.later_descents = 0; // so that the descents end before they begin
    ChainOptimiser chain(model, Grid::uniform(12, 15), along_v, settings);
    const OptimiserState state = run(chain, {});
    ASSERT_EQ(state.stages.back().name, "all nodes at once, exponent 2");
    ASSERT_LT(state.stages.back().of_best.max, state.stages[2].of_best.max);
    EXPECT_EQ(state.note, "The best grid of the stage \"all nodes at once, exponent 2\" is kept");
}

TEST(ChainOptimiser, SaysThatNoLinkWasTakenAndWhy) {
    const SpikeErrorModel model({.width = 0.02});
    ChainSettings settings = small_chain();
    settings.least_jacobian = 1.0; // which only the uniform grid has
    ChainOptimiser chain(model, Grid::uniform(8, 9), along_v, settings);
    const OptimiserState state = run(chain, {});
    EXPECT_EQ(state.status, OptimiserStatus::no_gain);
    EXPECT_EQ(state.note, "No stage was accepted, so the start grid is kept: a nearly folded cell");
}

TEST(ChainOptimiser, NeverReportsAGridThatBreaksThePromise) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const test::RandomErrorModel model(seed, true);
        const Grid start = Grid::uniform(5, 6);
        ChainSettings settings = small_chain();
        settings.first_descent = settings.later_descents = 3;
        ChainOptimiser chain(model, start, along_v, settings);
        const OptimiserState state = run(chain, {});
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
    ChainOptimiser chain(model, Grid::uniform(8, 9), along_v, small_chain());
    chain.advance({});
    chain.advance({});
    const OptimiserState before = chain.state();
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(chain.advance(Progress([](const Progress::Report&) {}, stop.get_token())), Cancelled);
    EXPECT_EQ(chain.state().best, before.best);
    EXPECT_EQ(chain.state().iteration, before.iteration);
    const OptimiserState after = run(chain, {});
    EXPECT_LE(after.of_best.max, before.of_best.max);
}

TEST(ChainOptimiser, RefusesSettingsThatMakeNoSense) {
    const SpikeErrorModel model({});
    const auto refused = [&](auto change) {
        ChainSettings settings = small_chain();
        change(settings);
        EXPECT_THROW(ChainOptimiser(model, Grid::uniform(5, 5), along_v, settings), Defect);
    };
    refused([](ChainSettings& s) { s.candidates_per_gap = 0; });
    refused([](ChainSettings& s) { s.widest_gap = 0.9; });
    refused([](ChainSettings& s) { s.narrowest_gap = 1.1; });
    refused([](ChainSettings& s) { s.exponents = {0.0}; });
    refused([](ChainSettings& s) { s.first_descent = -1; });
    refused([](ChainSettings& s) { s.tracks.polish_sweeps = -1; });
}

} // namespace
} // namespace millwright::grid
