#include "core/grid/elliptic_adaptation.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/expression_weight.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/pole_error_model.h"
#include "tests/support/test_weights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <random>
#include <stop_token>
#include <vector>

namespace millwright::grid {
namespace {

using test::infinity;

EllipticAdaptationSettings quick() {
    EllipticAdaptationSettings settings;
    settings.max_rounds = 4;
    settings.max_iterations = 60;
    return settings;
}

ErrorSummary finely(const ErrorModel& model, const Grid& grid) {
    return summary(measure(model, grid, TrackDirection::along_v, fine));
}

TEST(EllipticAdaptation, CutsTheMeanErrorOfAPole) {
    const PoleErrorModel model({});
    for (const Boundary boundary : {Boundary::fixed, Boundary::sliding}) {
        EllipticAdaptationSettings settings;
        settings.boundary = boundary;
        EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings);
        const OptimiserState state = run(adaptation, Progress());
        EXPECT_LT(finely(model, state.best).mean, 0.93 * finely(model, Grid::uniform(16, 16)).mean);
        EXPECT_LE(state.of_best.axis_max, state.start.axis_max);
        EXPECT_GT(state.best.min_jacobian(), 0.0);
        EXPECT_GT(state.round, 1);
        EXPECT_NE(state.status, OptimiserStatus::no_gain);
    }
}

TEST(EllipticAdaptation, CutsTheMeanErrorOfAPoleByMultigrid) {
    const PoleErrorModel model({});
    for (const Boundary boundary : {Boundary::fixed, Boundary::sliding}) {
        EllipticAdaptationSettings settings;
        settings.boundary = boundary;
        settings.method = EllipticMethod::multigrid;
        EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings);
        const OptimiserState state = run(adaptation, Progress());
        EXPECT_LT(finely(model, state.best).mean, 0.93 * finely(model, Grid::uniform(16, 16)).mean);
        EXPECT_GT(state.best.min_jacobian(), 0.0);
        EXPECT_NE(state.status, OptimiserStatus::no_gain);
    }
}

// T3.
TEST(EllipticAdaptation, TellsTheMemoryOfAMillionNodesBeforeItStarts) {
    for (const EllipticMethod method : {EllipticMethod::minimiser,
                                        EllipticMethod::multigrid,
                                        EllipticMethod::reference,
                                        EllipticMethod::harmonic}) {
        const double megabytes = static_cast<double>(memory_bytes(method, 1000, 1000)) / 1e6;
        EXPECT_GT(megabytes, 100.0);
        EXPECT_LT(megabytes, 4000.0);
        EXPECT_GT(memory_bytes(method, 1000, 1000), 90 * memory_bytes(method, 100, 100));
    }
}

// T17.
TEST(EllipticAdaptation, NeverReportsWorseThanTheStart) {
    const unsigned seed = 1997;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(0.0, 1.0);
    for (int n = 0; n < 8; ++n) {
        const PoleErrorModel model({.pole = {anywhere(random), anywhere(random)},
                                    .radius = 60.0 * anywhere(random),
                                    .background = 100.0 * anywhere(random)});
        EllipticAdaptationSettings settings = quick();
        settings.method = n % 2 == 0 ? EllipticMethod::minimiser : EllipticMethod::reference;
        settings.boundary = n % 4 < 2 ? Boundary::sliding : Boundary::fixed;
        const Grid start = Grid::uniform(9 + n, 12);
        EllipticAdaptation adaptation(model, start, settings);
        double best = infinity;
        while (adaptation.advance(Progress())) {
            EXPECT_LE(adaptation.state().of_best.mean, adaptation.state().start.mean);
            EXPECT_LE(adaptation.state().of_best.mean, best);
            best = adaptation.state().of_best.mean;
        }
        EXPECT_LE(finely(model, adaptation.state().best).mean, finely(model, start).mean);
    }
}

/// The track optimiser and the redistribution measure finely; people compare their figures with these.
TEST(EllipticAdaptation, TellsFineFiguresOfItsStartAndItsEnd) {
    const PoleErrorModel model({});
    const Grid start = Grid::uniform(12, 12);
    EllipticAdaptation adaptation(model, start, quick());
    ASSERT_TRUE(adaptation.advance(Progress()));
    EXPECT_EQ(adaptation.state().start.mean, finely(model, start).mean);
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.start.mean, finely(model, start).mean);
    EXPECT_EQ(state.of_best.mean, finely(model, state.best).mean);
    EXPECT_EQ(state.now.mean, finely(model, Grid(state.current)).mean);
}

TEST(EllipticAdaptation, SaysWhatRefusedBetterGrids) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.gap_allowance = 0.0;
    EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings);
    double least = infinity;
    while (adaptation.advance(Progress())) {
        least = std::min(least, adaptation.state().now.mean);
    }
    ASSERT_LT(least, adaptation.state().of_best.mean) << "else nothing was refused";
    EXPECT_NE(adaptation.state().note.find("were refused: "), std::string::npos) << adaptation.state().note;
    EXPECT_NE(adaptation.state().note.find("farther apart"), std::string::npos) << adaptation.state().note;
}

TEST(EllipticAdaptation, StaysWhereItIsWhenTheErrorIsEvenAlready) {
    const PoleErrorModel model({.radius = 0.0, .background = 20.0});
    const Grid start = Grid::uniform(10, 10);
    EllipticAdaptation adaptation(model, start, quick());
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.status, OptimiserStatus::no_gain);
    EXPECT_EQ(state.best, start);
    EXPECT_EQ(state.of_best.mean, state.start.mean);
}

TEST(EllipticAdaptation, HasNothingToDoWithoutAnError) {
    const PoleErrorModel model({.radius = 0.0, .background = 0.0});
    EllipticAdaptation adaptation(model, Grid::uniform(10, 10), quick());
    EXPECT_FALSE(adaptation.advance(Progress()));
    EXPECT_EQ(adaptation.state().status, OptimiserStatus::no_gain);
    EXPECT_EQ(adaptation.state().iteration, 0);
    EXPECT_FALSE(adaptation.advance(Progress()));
}

TEST(EllipticAdaptation, DoesNotMoveAFixedBoundaryByOneBit) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.boundary = Boundary::fixed;
    const Grid start = Grid::uniform(12, 15);
    EllipticAdaptation adaptation(model, start, settings);
    const OptimiserState state = run(adaptation, Progress());
    ASSERT_NE(state.current, start.array());
    for (const NodeArray& nodes : {state.best.array(), state.current}) {
        for (int i = 0; i < 12; ++i) {
            EXPECT_EQ(nodes.at(i, 0), start.node(i, 0));
            EXPECT_EQ(nodes.at(i, 14), start.node(i, 14));
        }
        for (int j = 0; j < 15; ++j) {
            EXPECT_EQ(nodes.at(0, j), start.node(0, j));
            EXPECT_EQ(nodes.at(11, j), start.node(11, j));
        }
    }
}

TEST(EllipticAdaptation, LessensTheAdaptationWhenTheReferenceSolverFolds) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.method = EllipticMethod::reference;
    settings.boundary = Boundary::fixed;
    EllipticAdaptation adaptation(model, Grid::uniform(25, 25), settings, weight_w1()); // folds at LV = 100
    adaptation.advance(Progress());
    EXPECT_EQ(adaptation.adaptation(), 10.0);
    EXPECT_EQ(adaptation.state().iteration, 1);
    EXPECT_NE(adaptation.state().note.find("folded at LV = 100"), std::string::npos);
    EXPECT_EQ(adaptation.state().current, Grid::uniform(25, 25).array());
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_NE(state.status, OptimiserStatus::folded);
    EXPECT_EQ(adaptation.adaptation(), 10.0);
    EXPECT_THAT(state.warning,
                testing::StartsWith("LV = 10 was used instead of 100: a cell folded at LV = 100."));
}

// The thesis's test at LV = 100: the round ended "at iteration 221", but its limit is 220.
TEST(EllipticAdaptation, CountsTheIterationsBeforeANewStartEverywhere) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.method = EllipticMethod::reference;
    settings.boundary = Boundary::fixed;
    settings.max_rounds = 1;
    settings.max_iterations = 20;
    settings.iterations_per_step = 20;
    EllipticAdaptation adaptation(model, Grid::uniform(25, 25), settings, weight_w1()); // folds at LV = 100
    (void)adaptation.advance(Progress());
    (void)adaptation.advance(Progress());
    EXPECT_EQ(adaptation.state().iteration, 21);
    EXPECT_THAT(adaptation.state().note, testing::StartsWith("Round 1, iteration 21: "));
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.iteration, 21);
    EXPECT_EQ(std::ssize(state.norms), 21);
    EXPECT_THAT(state.warning, testing::HasSubstr("round 1 ended after 20 iterations with a residual"));
}

TEST(EllipticAdaptation, SaysWhereTheSolverOfTheLastRoundDidNotConverge) {
    const PoleErrorModel model({});
    for (const EllipticMethod method :
         {EllipticMethod::minimiser, EllipticMethod::multigrid, EllipticMethod::harmonic}) {
        EllipticAdaptationSettings settings = quick();
        settings.method = method;
        settings.max_rounds = 2;
        settings.max_iterations = 1;
        EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings);
        const OptimiserState cut_off = run(adaptation, Progress());
        ASSERT_GT(cut_off.norm, settings.tolerance);
        EXPECT_THAT(cut_off.warning,
                    testing::MatchesRegex("The solver did not converge: round 2 ended after 1 iteration with "
                                          "a residual of [0-9.e+-]+; the tolerance is 0.001\\."));
        settings.max_iterations = 250;
        settings.tolerance = 1e6;
        EllipticAdaptation loose(model, Grid::uniform(16, 16), settings);
        EXPECT_EQ(run(loose, Progress()).warning, "");
    }
}

TEST(EllipticAdaptation, TheHarmonicMapHasNoLv) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = harmonic_settings();
    settings.max_iterations = 3;
    settings.max_rounds = 1;
    EllipticAdaptation map(model, Grid::uniform(8, 8), settings);
    const OptimiserState state = run(map, Progress());
    ASSERT_EQ(state.norms.size(), 3U);
    EXPECT_TRUE(std::isnan(state.norms.front().adaptation));
    settings.method = EllipticMethod::minimiser;
    EllipticAdaptation elliptic(model, Grid::uniform(8, 8), settings);
    EXPECT_EQ(run(elliptic, Progress()).norms.front().adaptation, settings.functional.adaptation);
    EllipticAdaptation broken(model, Grid::uniform(6, 6), harmonic_settings(), broken_weight(infinity));
    const OptimiserState failed = run(broken, Progress());
    EXPECT_EQ(failed.note, "Stopped: a value is not finite");
    EXPECT_EQ(failed.warning, "") << "less LV would not help";
}

TEST(EllipticAdaptation, GivesUpAsFoldedWhenNothingElseHelps) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.method = EllipticMethod::reference;
    settings.functional.adaptation = 1e6;
    const Grid start = Grid::uniform(25, 25);
    EllipticAdaptation adaptation(model, start, settings, weight_w1());
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.status, OptimiserStatus::folded);
    EXPECT_EQ(state.best, start);
    EXPECT_EQ(state.iteration, 4);
    EXPECT_NE(state.note.find("folded"), std::string::npos);
}

TEST(EllipticAdaptation, ReportsAWeightThatIsNotFinite) {
    const PoleErrorModel model({});
    EllipticAdaptation adaptation(model, Grid::uniform(6, 6), quick(), broken_weight(infinity));
    EXPECT_EQ(run(adaptation, Progress()).status, OptimiserStatus::not_finite);
}

TEST(EllipticAdaptation, FollowsAWeightThatAPersonGave) {
    const PoleErrorModel model({});
    const WeightPtr weight = expression_weight("0.1 + exp(-20*((u-0.48)^2 + (v-0.53)^2))", 16, 16);
    EllipticAdaptationSettings settings;
    settings.max_iterations = 40; // not enough, so a second round goes on
    EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings, weight);
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.status, OptimiserStatus::converged);
    EXPECT_GT(state.round, 1);
    EXPECT_LE(state.norm, settings.tolerance);
    EXPECT_LT(state.of_best.mean, state.start.mean);
}

// T16.
TEST(EllipticAdaptation, WarnsOfAWeightThatIsNotPositive) {
    const PoleErrorModel model({});
    EllipticAdaptation adaptation(model, Grid::uniform(25, 25), quick(), weight_w4());
    EXPECT_NE(adaptation.state().warning.find("not positive at 337 of 625 nodes"), std::string::npos);
    adaptation.advance(Progress());
    EXPECT_NE(adaptation.state().warning.find("not positive at 337 of 625 nodes"), std::string::npos);
}

/// Later rounds start from grids that a person never sees.
TEST(EllipticAdaptation, CountsNodesOfTheStartGridInEveryRound) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    settings.max_iterations = 5;
    settings.max_rounds = 4;
    EllipticAdaptation adaptation(model, Grid::uniform(16, 16), settings, expression_weight("u-0.5", 16, 16));
    const OptimiserState end = run(adaptation, Progress());
    EXPECT_GT(end.round, 1);
    EXPECT_NE(end.warning.find("not positive at 128 of 256 nodes of the start grid"), std::string::npos)
        << end.warning;
}

// It stays said, whatever else there is to say of a step or the end.
TEST(EllipticAdaptation, WarnsOfAWeightOfTheErrorThatIsNotPositive) {
    const PoleErrorModel model({});
    EllipticAdaptation adaptation(
        model, Grid::uniform(25, 25), quick(), [](const WeightPtr&) { return weight_w4(); });
    EXPECT_EQ(adaptation.state().warning, "");
    const OptimiserState end = run(adaptation, Progress());
    EXPECT_NE(end.warning.find("not positive at"), std::string::npos) << end.note;
}

// T18.
TEST(EllipticAdaptation, DoesAsManyIterationsAStepAsAskedWithTheSameResult) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings = quick();
    std::vector<OptimiserState> ends;
    for (const int step : {1, 7, 10, 1000}) {
        settings.iterations_per_step = step;
        EllipticAdaptation adaptation(model, Grid::uniform(12, 12), settings);
        adaptation.advance(Progress());
        EXPECT_LE(adaptation.state().iteration, step);
        EXPECT_EQ(adaptation.state().current.rows, 12);
        ends.push_back(run(adaptation, Progress()));
    }
    for (const OptimiserState& end : ends) {
        EXPECT_EQ(end.best, ends.front().best);
        EXPECT_EQ(end.iteration, ends.front().iteration);
    }
}

TEST(EllipticAdaptation, GivesTheSameGridOnAnyNumberOfThreads) {
    const PoleErrorModel model({});
    std::vector<Grid> found;
    for (const int threads : {1, 2, 7}) {
        set_thread_count(threads);
        EllipticAdaptation adaptation(model, Grid::uniform(40, 40), quick());
        for (int n = 0; n < 8; ++n) {
            adaptation.advance(Progress());
        }
        found.emplace_back(adaptation.state().current);
    }
    set_thread_count(0);
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
}

TEST(EllipticAdaptation, CancelledIsAsBeforeTheStepAndCanGoOn) {
    const PoleErrorModel model({});
    EllipticAdaptation cancelled(model, Grid::uniform(12, 12), quick());
    EllipticAdaptation straight(model, Grid::uniform(12, 12), quick());
    cancelled.advance(Progress());
    straight.advance(Progress());
    const int iteration = cancelled.state().iteration;
    const NodeArray current = cancelled.state().current;
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(cancelled.advance(Progress(nullptr, stop.get_token())), Cancelled);
    EXPECT_EQ(cancelled.state().iteration, iteration);
    EXPECT_EQ(cancelled.state().current, current);
    EXPECT_EQ(run(cancelled, Progress()).best, run(straight, Progress()).best);
}

/// Cancels after some moves were asked for.
class StoppingModel final : public ErrorModel {
public:
    StoppingModel(std::stop_source& stop, int moves) : stop_(stop), left_(moves) {}
    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const override {
        if (--left_ == 0) {
            stop_.request_stop();
        }
        return inner_.move(a, b, sampling);
    }
    [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                         Sampling sampling) const override {
        return inner_.lattice(nodes, sampling);
    }
    [[nodiscard]] double track_gap(const Grid& grid, TrackDirection direction) const override {
        return inner_.track_gap(grid, direction);
    }

private:
    PoleErrorModel inner_{{}};
    std::stop_source& stop_;
    mutable std::atomic<int> left_;
};

TEST(EllipticAdaptation, CanBeCancelledInTheMiddleOfAMeasurement) {
    std::stop_source stop;
    const StoppingModel model(stop, 15 * 14 + 15 * 7); // in the middle of the second measurement
    EllipticAdaptation adaptation(model, Grid::uniform(15, 15), quick());
    EXPECT_THROW(adaptation.advance(Progress(nullptr, stop.get_token())), Cancelled);
    EXPECT_EQ(adaptation.state().iteration, 0);
    EXPECT_EQ(adaptation.state().current, Grid::uniform(15, 15).array());
}

TEST(EllipticAdaptation, StartsFromMovesOutOfReach) {
    class HalfReached final : public ErrorModel {
    public:
        [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const override {
            return a.x() > 0.5 ? MoveError{infinity, infinity, 1.0} : inner_.move(a, b, sampling);
        }
        [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                             Sampling sampling) const override {
            return inner_.lattice(nodes, sampling);
        }
        [[nodiscard]] double track_gap(const Grid& grid, TrackDirection direction) const override {
            return inner_.track_gap(grid, direction);
        }

    private:
        PoleErrorModel inner_{{}};
    };
    const HalfReached model;
    EllipticAdaptation adaptation(model, Grid::uniform(8, 8), quick());
    const OptimiserState state = run(adaptation, Progress());
    EXPECT_EQ(state.status, OptimiserStatus::no_gain);
    EXPECT_EQ(state.start.mean, infinity);
}

TEST(EllipticAdaptation, TellsHowFarItIs) {
    const PoleErrorModel model({});
    std::vector<Progress::Report> reports;
    const Progress progress([&](const Progress::Report& report) { reports.push_back(report); }, {});
    EllipticAdaptation adaptation(model, Grid::uniform(10, 10), quick());
    (void)run(adaptation, progress);
    ASSERT_GT(reports.size(), 3U);
    EXPECT_GT(reports.back().fraction, reports.front().fraction);
    for (const char* text :
         {"Measuring the start grid", "Round 1", "Evaluating the start grid", "Evaluating grid 1 of"}) {
        EXPECT_TRUE(std::ranges::any_of(reports, [&](const Progress::Report& report) {
            return report.text.find(text) != std::string::npos;
        })) << text;
    }
}

TEST(EllipticAdaptation, RefusesSettingsWithoutSense) {
    const PoleErrorModel model({});
    const auto with = [&](auto change) {
        EllipticAdaptationSettings settings;
        change(settings);
        return EllipticAdaptation(model, Grid::uniform(5, 5), settings);
    };
    EXPECT_THROW(with([](auto& s) { s.max_rounds = 0; }), Defect);
    EXPECT_THROW(with([](auto& s) { s.iterations_per_step = 0; }), Defect);
    EXPECT_THROW(with([](auto& s) { s.functional.adaptation = -1.0; }), Defect);
    EXPECT_THROW(with([](auto& s) { s.error_weight.floor = 0.0; }), Defect);
    EXPECT_THROW(with([](auto& s) { s.memory = 1.0; }), Defect);
    EllipticAdaptationSettings reference;
    reference.method = EllipticMethod::reference;
    EXPECT_THROW(EllipticAdaptation(model, Grid::uniform(2, 5), reference), Defect);
    EXPECT_NO_THROW(EllipticAdaptation(model, Grid::uniform(2, 5), {}));
}

// The norm of the thesis's log, iteration by iteration: an independent implementation's first five.
TEST(EllipticAdaptation, KeepsTheNormOfEveryIterationAndWhatTheEquationsLeave) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings;
    settings.method = EllipticMethod::reference;
    settings.boundary = Boundary::fixed;
    settings.functional.adaptation = 1.0;
    settings.max_iterations = 35;
    settings.max_rounds = 2;
    EllipticAdaptation adaptation(model, Grid::uniform(25, 25), settings, weight_w1());
    EXPECT_FALSE(adaptation.residuals()) << "nothing was iterated";
    const OptimiserState state = run(adaptation, Progress());
    ASSERT_EQ(state.norms.size(), 70U);
    EXPECT_EQ(state.iteration, 70);
    const double first[]{0.4045922466, 0.328164831, 0.2664142164, 0.2161995387, 0.175208779};
    for (std::size_t n = 0; n < std::size(first); ++n) {
        EXPECT_NEAR(state.norms[n].norm, first[n], 1e-8 * first[n]) << n;
    }
    EXPECT_EQ(state.norms[34].round, 1);
    EXPECT_EQ(state.norms[35].round, 2);
    EXPECT_DOUBLE_EQ(state.norms[69].norm, state.norm);
    EXPECT_DOUBLE_EQ(state.norms[69].adaptation, 1.0);
    EXPECT_EQ(state.reached, state.current);
    const auto residuals = adaptation.residuals();
    ASSERT_TRUE(residuals);
    double largest = 0.0;
    for (const Vec2& r : residuals->nodes) {
        largest = std::max(largest, 0.5 * (std::abs(r.x()) + std::abs(r.y())));
    }
    EXPECT_NEAR(largest, state.norm, 1e-9 * state.norm);
}

/// LV = 100 folds the grid in its first iteration: the norm of that one is there, and LV of the next is less.
TEST(EllipticAdaptation, NormsTellWhereTheSolverFellBack) {
    const PoleErrorModel model({});
    EllipticAdaptationSettings settings;
    settings.method = EllipticMethod::reference;
    settings.boundary = Boundary::fixed;
    settings.functional.adaptation = 100.0;
    settings.max_iterations = 12;
    settings.max_rounds = 1;
    EllipticAdaptation adaptation(model, Grid::uniform(25, 25), settings, weight_w1());
    const OptimiserState state = run(adaptation, Progress());
    ASSERT_EQ(state.norms.size(), 13U);
    EXPECT_NEAR(state.norms[0].norm, 189.082913, 1e-4);
    EXPECT_DOUBLE_EQ(state.norms[0].adaptation, 100.0);
    EXPECT_DOUBLE_EQ(state.norms[1].adaptation, 10.0);
    EXPECT_EQ(state.norms[1].round, 1);
}

} // namespace
} // namespace millwright::grid
