#include "core/grid/track_optimiser.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

namespace millwright::grid {
namespace {

using test::along_v;
using test::infinity;

/// Small enough for tests. The models' gap is between nodes of equal number, so it opens when nodes slide.
TrackSettings small_tracks() {
    TrackSettings settings;
    settings.lattice = 60;
    settings.polish_sweeps = 5;
    settings.gap_allowance = 2.0;
    return settings;
}

OptimiserState
optimised(const ErrorModel& model, const Grid& start, TrackSettings settings = small_tracks()) {
    TrackOptimiser optimiser(model, start, along_v, settings);
    return run(optimiser, {});
}

/// The tip's distances of a model with one more thing in them: nothing beyond v = 0.7 can be reached.
class OutOfReach final : public ErrorModel {
public:
    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const override {
        MoveError found = inner_.move(a, b, sampling);
        if (std::max(a.y(), b.y()) > 0.7 && a.x() > 0.6) {
            found.tip = found.axis = found.off_surface = found.param = infinity;
        }
        return found;
    }
    [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                         Sampling sampling) const override {
        return std::make_unique<Lattice>(*this, std::vector<Vec2>(nodes.begin(), nodes.end()), sampling);
    }
    [[nodiscard]] double track_gap(const Grid& grid, TrackDirection direction) const override {
        return inner_.track_gap(grid, direction);
    }

private:
    struct Lattice final : LatticeErrors {
        Lattice(const OutOfReach& m, std::vector<Vec2> n, Sampling s)
            : model(m), nodes(std::move(n)), sampling(s) {}
        [[nodiscard]] MoveError between(int k, int l) const override {
            return model.move(
                nodes[static_cast<std::size_t>(k)], nodes[static_cast<std::size_t>(l)], sampling);
        }
        const OutOfReach& model;
        std::vector<Vec2> nodes;
        Sampling sampling;
    };
    SpikeErrorModel inner_{{}};
};

TEST(TrackOptimiser, CutsTheErrorOfASpike) {
    const SpikeErrorModel model({.width = 0.02});
    const OptimiserState state = optimised(model, Grid::uniform(12, 15));
    EXPECT_LT(state.of_best.mean, 0.9 * state.start.mean);
    EXPECT_LT(state.of_best.max, 0.4 * state.start.max);
    EXPECT_LT(state.of_best.lmean, state.start.lmean);
    EXPECT_NE(state.status, OptimiserStatus::no_gain);
    EXPECT_GT(state.best.min_jacobian(), 0.0);
}

TEST(TrackOptimiser, NeverReportsAGridWorseThanTheStart) {
    // The worst case: an error that jumps from node to node, and that fine sampling sees quite otherwise than
    // the search does.
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::RandomErrorModel model(seed, true);
        const Grid start = Grid::uniform(5, 7);
        TrackSettings settings = small_tracks();
        settings.gap_allowance = 0.3;
        const OptimiserState state = optimised(model, start, settings);
        const auto moves = measure(model, state.best, along_v, fine);
        const ErrorSummary found = summary(moves);
        const ErrorSummary before = summary(measure(model, start, along_v, fine));
        EXPECT_LE(found.max, before.max + 1e-6) << seed;
        EXPECT_LE(found.mean, before.mean + 1e-6) << seed;
        EXPECT_LE(found.lmean, before.lmean + 1e-6) << seed;
        EXPECT_LE(found.axis_max, before.axis_max + 1e-8) << seed;
        EXPECT_LE(model.track_gap(state.best, along_v), 1.3 * model.track_gap(start, along_v)) << seed;
        EXPECT_EQ(state.of_best.mean, found.mean);
        EXPECT_EQ(state.start.mean, before.mean);
    }
}

TEST(TrackOptimiser, KeepsTracksStraightAndTheirEndsOnTheEdge) {
    const SpikeErrorModel model({});
    TrackOptimiser optimiser(model, Grid::uniform(9, 6), TrackDirection::along_u, small_tracks());
    const Grid best = run(optimiser, {}).best;
    for (int j = 0; j < 6; ++j) {
        EXPECT_EQ(best.node(0, j), Vec2(0.0, j / 5.0));
        EXPECT_EQ(best.node(8, j), Vec2(1.0, j / 5.0));
        for (int i = 0; i < 9; ++i) {
            EXPECT_EQ(best.node(i, j).y(), j / 5.0);
        }
    }
}

TEST(TrackOptimiser, IsWatchedStepByStepAndCostsNoStepTooMany) {
    const SpikeErrorModel model({});
    TrackOptimiser optimiser(model, Grid::uniform(6, 9), along_v, small_tracks());
    EXPECT_EQ(optimiser.state().current, Grid::uniform(6, 9).array());
    EXPECT_TRUE(optimiser.advance({}));
    EXPECT_GT(optimiser.state().start.mean, 0.0);
    EXPECT_EQ(optimiser.state().of_best.mean, optimiser.state().start.mean);
    EXPECT_TRUE(optimiser.advance({}));
    const double after_paths = optimiser.state().of_best.mean;
    EXPECT_LT(after_paths, optimiser.state().start.mean);
    int sweeps = 0;
    while (optimiser.advance({})) {
        ++sweeps;
        EXPECT_EQ(optimiser.state().status, OptimiserStatus::running);
        EXPECT_FALSE(optimiser.state().note.empty());
    }
    EXPECT_EQ(sweeps, 4);
    EXPECT_EQ(optimiser.state().iteration, 5);
    EXPECT_EQ(optimiser.state().status, OptimiserStatus::iteration_limit);
    const OptimiserState last = optimiser.state();
    EXPECT_FALSE(optimiser.advance({}));
    EXPECT_EQ(optimiser.state().best, last.best);
}

class TrackOptimiserThreads : public ::testing::Test {
protected:
    ~TrackOptimiserThreads() override { set_thread_count(0); }
};

TEST_F(TrackOptimiserThreads, GivesTheSameBytesOnAnyNumberOfThreads) {
    const SpikeErrorModel model({});
    set_thread_count(1);
    const OptimiserState one = optimised(model, Grid::uniform(8, 10));
    for (const int threads : {2, 7}) {
        set_thread_count(threads);
        const OptimiserState many = optimised(model, Grid::uniform(8, 10));
        EXPECT_EQ(many.best, one.best) << threads;
        EXPECT_EQ(many.of_best.mean, one.of_best.mean);
        EXPECT_EQ(many.norm, one.norm);
        EXPECT_EQ(many.note, one.note);
    }
}

TEST(TrackOptimiser, LeavesItsStateWhenAStepIsCancelledAndGoesOnAfterwards) {
    const SpikeErrorModel model({});
    const Grid start = Grid::uniform(6, 9);
    TrackOptimiser interrupted(model, start, along_v, small_tracks());
    std::stop_source stop;
    stop.request_stop();
    const Progress cancelled(nullptr, stop.get_token());
    bool more = true;
    while (more) {
        const OptimiserState before = interrupted.state();
        EXPECT_THROW((void)interrupted.advance(cancelled), Cancelled);
        EXPECT_EQ(interrupted.state().current, before.current);
        EXPECT_EQ(interrupted.state().best, before.best);
        EXPECT_EQ(interrupted.state().round, before.round);
        EXPECT_EQ(interrupted.state().note, before.note);
        more = interrupted.advance({});
    }
    EXPECT_EQ(interrupted.state().best, optimised(model, start).best);
}

TEST(TrackOptimiser, IsCancelledInTheMiddleOfAStep) {
    const SpikeErrorModel model({});
    std::stop_source stop;
    const Progress progress(
        [&](const Progress::Report& report) {
            if (report.fraction > 0.3) { // of the whole way; the first step ends at 0.5
                stop.request_stop();
            }
        },
        stop.get_token());
    TrackOptimiser optimiser(model, Grid::uniform(20, 9), along_v, small_tracks());
    EXPECT_THROW((void)optimiser.advance(progress), Cancelled);
    EXPECT_EQ(optimiser.state().round, 0);
    EXPECT_TRUE(optimiser.advance({}));
}

TEST(TrackOptimiser, LeavesTracksThatCannotBeReached) {
    const OutOfReach model;
    const Grid start = Grid::uniform(6, 8);
    const OptimiserState state = optimised(model, start);
    for (int j = 0; j < 8; ++j) {
        EXPECT_EQ(state.best.node(5, j), start.node(5, j));
    }
    EXPECT_EQ(state.start.mean, infinity);
}

TEST(TrackOptimiser, SaysSoWhenThereIsNothingToGain) {
    const SpikeErrorModel model({.spike = {0.0, 0.3}});
    TrackSettings settings = small_tracks();
    settings.lattice = 9;
    settings.longest_move = 1.5;
    settings.shortest_move = 0.5;
    const OptimiserState state = optimised(model, Grid::uniform(4, 2), settings); // one move per track
    EXPECT_EQ(state.best, Grid::uniform(4, 2));
    EXPECT_EQ(state.of_best.mean, state.start.mean);

    settings.gap_allowance = 0.0; // and here the tracks slide apart
    const OptimiserState kept = optimised(model, Grid::uniform(2, 9), settings);
    EXPECT_EQ(kept.status, OptimiserStatus::no_gain);
    EXPECT_EQ(kept.best, Grid::uniform(2, 9));
}

TEST(TrackOptimiser, QuickSettingsTakeTwoSteps) {
    const SpikeErrorModel model({});
    TrackOptimiser optimiser(model, Grid::uniform(6, 9), along_v, quick_track_settings());
    EXPECT_TRUE(optimiser.advance({}));
    EXPECT_FALSE(optimiser.advance({}));
    EXPECT_EQ(optimiser.state().status, OptimiserStatus::converged);
    EXPECT_LT(optimiser.state().of_best.mean, optimiser.state().start.mean);
}

TEST(TrackOptimiser, RefusesSettingsOutsideTheirRange) {
    const test::WithoutTraps numbers_that_are_none;
    const SpikeErrorModel model({});
    const auto refused = [&](auto change) {
        TrackSettings settings;
        change(settings);
        EXPECT_THROW(TrackOptimiser(model, Grid::uniform(4, 9), along_v, settings), Defect);
    };
    refused([](TrackSettings& s) { s.lattice = 8; });
    refused([](TrackSettings& s) { s.error_exponent = 0.9; });
    refused([](TrackSettings& s) { s.tip_share = 1.1; });
    refused([](TrackSettings& s) { s.axis_share = -0.1; });
    refused([](TrackSettings& s) { s.monitor_share = 1.0; });
    refused([](TrackSettings& s) { s.longest_move = 1.0; });
    refused([](TrackSettings& s) { s.shortest_move = 0.6; });
    refused([](TrackSettings& s) { s.polish_sweeps = -1; });
    refused([](TrackSettings& s) { s.worst_share = std::numeric_limits<double>::quiet_NaN(); });
    refused([](TrackSettings& s) { s.gap_allowance = -0.1; });
    refused([](TrackSettings& s) { s.axis_weight_mm_per_deg = infinity; });
}

TEST(TrackOptimiser, RefusesTracksThatAreBent) {
    const SpikeErrorModel model({});
    NodeArray nodes = Grid::uniform(4, 9).array();
    nodes.at(1, 4).x() += 0.05;
    EXPECT_THROW(TrackOptimiser(model, Grid(nodes), along_v, {}), Defect);
}

} // namespace
} // namespace millwright::grid
