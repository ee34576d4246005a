#include "core/base/error.h"
#include "core/grid/track_path.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::grid {
namespace {

PlacedTrack uniform_track(int nodes) {
    PlacedTrack found{{TrackDirection::along_v, 0.5}, {}};
    for (int n = 0; n < nodes; ++n) {
        found.places.push_back(static_cast<double>(n) / (nodes - 1));
    }
    return found;
}

double total_move_cost(const TrackPolish& polish, const MoveCost& cost) {
    double sum = 0.0;
    for (const MoveError& move : polish.moves()) {
        sum += cost(move);
    }
    return sum;
}

TEST(TrackPolish, NeverRaisesTheCostAndKeepsTheEnds) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const test::RandomErrorModel model(seed);
        const PolishSettings settings{.cost = {.axis_weight = 0.5}, .min_gap = 0.01};
        TrackPolish polish(model, uniform_track(9), settings);
        double before = total_move_cost(polish, settings.cost);
        for (int sweep = 0; sweep < 10; ++sweep) {
            (void)polish.sweep({});
            const double after = total_move_cost(polish, settings.cost);
            EXPECT_LE(after, before * (1.0 + 1e-15)) << seed;
            before = after;
        }
        EXPECT_EQ(polish.track().places.front(), 0.0);
        EXPECT_EQ(polish.track().places.back(), 1.0);
        EXPECT_TRUE(std::ranges::is_sorted(polish.track().places));
    }
}

TEST(TrackPolish, NeverWorsensAMoveBeyondTheLimits) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const test::RandomErrorModel model(seed);
        const PolishSettings settings{.limits = {.tip = 0.5, .axis = 0.6}};
        TrackPolish polish(model, uniform_track(9), settings);
        const auto worst = [&](double MoveError::*quantity) {
            return std::ranges::max(polish.moves(), {}, quantity).*quantity;
        };
        const double tip = std::max(0.5, worst(&MoveError::tip));
        const double axis = std::max(0.6, worst(&MoveError::axis));
        for (int sweep = 0; sweep < 10; ++sweep) {
            (void)polish.sweep({});
        }
        EXPECT_LE(worst(&MoveError::tip), tip) << seed;
        EXPECT_LE(worst(&MoveError::axis), axis) << seed;
    }
}

TEST(TrackPolish, SettlesWhereTheErrorIsSpreadEvenly) {
    // e = kappa h^2 with constant kappa: equal steps are best, from wherever one starts.
    const SpikeErrorModel model({.background = 20.0, .height = 0.0, .limit = 1e9});
    PlacedTrack start = uniform_track(6);
    start.places = {0.0, 0.05, 0.3, 0.35, 0.9, 1.0};
    TrackPolish polish(model, start, {.min_gap = 0.001});
    double longest = 1.0;
    for (int sweep = 0; sweep < 200; ++sweep) {
        longest = polish.sweep({});
    }
    EXPECT_LT(longest, 1e-5);
    for (std::size_t n = 0; n < 6; ++n) {
        EXPECT_NEAR(polish.track().places[n], 0.2 * static_cast<double>(n), 1e-3);
    }
}

TEST(TrackPolish, KeepsNodesApartWhereMovesCostNothing) {
    // All of the error is in the second half: without a least gap, nodes of the first half would all go
    // there.
    const SpikeErrorModel model({.spike = {0.5, 0.9}, .background = 0.0, .limit = 1e9});
    TrackPolish polish(model, uniform_track(11), {.min_gap = 0.02});
    for (int sweep = 0; sweep < 100; ++sweep) {
        (void)polish.sweep({});
    }
    for (std::size_t n = 1; n < 11; ++n) {
        EXPECT_GE(polish.track().places[n] - polish.track().places[n - 1], 0.02);
    }
}

TEST(TrackPolish, IsCancelled) {
    const SpikeErrorModel model({});
    TrackPolish polish(model, uniform_track(5), {});
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)polish.sweep(Progress(nullptr, stop.get_token())), Cancelled);
}

} // namespace
} // namespace millwright::grid
