// The oracle is brute force: every choice of nodes is tried.
#include "core/grid/track_path.h"

#include "core/base/error.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace millwright::grid {
namespace {

using test::infinity;

const Track track{TrackDirection::along_v, 0.4};

std::vector<double> random_places(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> step(0.5, 1.5);
    std::vector<double> places{0.0};
    for (int n = 1; n < count; ++n) {
        places.push_back(places.back() + step(random));
    }
    for (double& place : places) {
        place /= places.back();
    }
    places.back() = 1.0;
    return places;
}

/// Every path of `moves` moves from the first place to the last inside the table's windows.
void each_path(const MoveTable& table,
               int moves,
               const std::function<void(const std::vector<int>&)>& visit,
               std::vector<int> path = {0}) {
    const int here = path.back();
    if (moves == 0) {
        if (here == table.size() - 1) {
            visit(path);
        }
        return;
    }
    for (int next = table.first(here); next < table.end(here); ++next) {
        path.push_back(next);
        each_path(table, moves - 1, visit, path);
        path.pop_back();
    }
}

template <typename Value> double value_of(const MoveTable& table, const std::vector<int>& path, Value value) {
    double found = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        found = value(found, table.move(path[n - 1], path[n]));
    }
    return found;
}

template <typename Value> double least_of_all(const MoveTable& table, int moves, Value value) {
    double least = infinity;
    each_path(table, moves, [&](const std::vector<int>& path) {
        least = std::min(least, value_of(table, path, value));
    });
    return least;
}

class OptimalPath : public ::testing::TestWithParam<unsigned> {
protected:
    test::RandomErrorModel model_{GetParam()};
    MoveTable table_{model_, track, random_places(13, GetParam()), {0.05, 0.6}, coarse, {}};
    MoveLimits limits_{.tip = 0.8, .axis = 0.85};
};

TEST_P(OptimalPath, CostsWhatTheBestOfAllChoicesCosts) {
    const MoveCost cost{.exponent = 1.5, .tip_share = 0.3, .axis_weight = 0.2, .length_share = 0.5};
    for (const int moves : {1, 2, 4, 7}) {
        for (const MoveLimits& limits : {MoveLimits{}, limits_}) {
            const auto sum = [&](double before, const MoveError& move) {
                return before + (limits.allow(move) ? cost(move) : infinity);
            };
            const double least = least_of_all(table_, moves, sum);
            const auto path = cheapest_path(table_, moves, cost, limits);
            ASSERT_EQ(path.has_value(), least < infinity) << moves;
            if (path) {
                EXPECT_DOUBLE_EQ(path->value, least);
                EXPECT_DOUBLE_EQ(value_of(table_, path->nodes, sum), least);
                EXPECT_EQ(std::ssize(path->nodes), moves + 1);
                EXPECT_EQ(places_of(table_, *path).back(), 1.0);
            }
        }
    }
}

TEST_P(OptimalPath, HasTheLeastWorstMoveOfAllChoices) {
    for (double MoveError::*const quantity : {&MoveError::tip, &MoveError::axis}) {
        for (const MoveLimits& limits : {MoveLimits{}, limits_}) {
            const auto worst = [&](double before, const MoveError& move) {
                return std::max(before, limits.allow(move) ? move.*quantity : infinity);
            };
            const double least = least_of_all(table_, 5, worst);
            const auto path = least_worst_path(table_, 5, quantity, limits);
            ASSERT_EQ(path.has_value(), least < infinity);
            if (path) {
                EXPECT_EQ(path->value, least);
                EXPECT_EQ(value_of(table_, path->nodes, worst), least);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OptimalPath, ::testing::Range(1U, 13U));

TEST(MoveTable, HoldsTheMovesInsideItsWindowAndNoOthers) {
    const SpikeErrorModel model({});
    const MoveTable table(model, track, {0.0, 0.1, 0.3, 0.4, 0.9, 1.0}, {0.2, 0.5}, coarse, {});
    EXPECT_EQ(table.first(0), 2);
    EXPECT_EQ(table.end(0), 4);
    EXPECT_EQ(table.first(3), 4) << "exactly the longest move is inside";
    EXPECT_EQ(table.end(3), 5);
    EXPECT_EQ(table.first(5), table.end(5));
    EXPECT_EQ(table.move(0, 2).tip, model.move(track.at(0.0), track.at(0.3), coarse).tip);
    EXPECT_THROW((void)table.move(0, 1), Defect);
    EXPECT_EQ(table.index_of(0.4), 3);
    EXPECT_THROW((void)table.index_of(0.41), Defect);
}

TEST(CheapestPath, IsNothingIfTheMovesAreTooFewForTheWindow) {
    const SpikeErrorModel model({});
    const MoveTable table(model, track, {0.0, 0.25, 0.5, 0.75, 1.0}, {0.0, 0.25}, coarse, {});
    EXPECT_FALSE(cheapest_path(table, 3, {}, {}));
    EXPECT_TRUE(cheapest_path(table, 4, {}, {}));
    EXPECT_FALSE(cheapest_path(table, 5, {}, {}));
}

TEST(MoveTable, IsCancelledInsideItsRows) {
    const SpikeErrorModel model({});
    std::stop_source stop;
    stop.request_stop();
    const Progress cancelled(nullptr, stop.get_token());
    EXPECT_THROW(MoveTable(model, track, {0.0, 0.5, 1.0}, {0.0, 1.0}, coarse, cancelled), Cancelled);
}

} // namespace
} // namespace millwright::grid
