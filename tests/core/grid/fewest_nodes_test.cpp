#include "core/grid/fewest_nodes.h"

#include "core/base/error.h"
#include "core/grid/track.h"
#include "core/grid/track_path.h"
#include "tests/support/closed_form_error_model.h"
#include "tests/support/random_error_model.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::grid {
namespace {

constexpr Track middle_track{TrackDirection::along_v, 0.5};

TEST(ShortestPath, HasTheFewestMovesAndOfThoseTheCheapest) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::RandomErrorModel model(seed);
        std::vector<double> places;
        for (int n = 0; n <= 14; ++n) {
            places.push_back(n / 14.0);
        }
        const MoveTable table(model, middle_track, places, {0.0, 0.4}, coarse, {});
        const MoveLimits limits{0.3, 0.7};
        const auto path = shortest_path(table, {}, limits);
        std::optional<LatticePath> expected;
        for (int moves = 1; moves <= 14 && !expected; ++moves) {
            expected = cheapest_path(table, moves, {}, limits);
        }
        ASSERT_EQ(path.has_value(), expected.has_value()) << seed;
        if (path) {
            EXPECT_EQ(path->nodes, expected->nodes) << seed;
            EXPECT_DOUBLE_EQ(path->value, expected->value);
        }
    }
}

TEST(FewestNodes, AreAsManyAsTheClosedFormSays) {
    // kappa h^2 everywhere: moves of length sqrt(tolerance / kappa).
    const SpikeErrorModel even({.background = 20.0, .height = 0.0, .limit = 1e9});
    for (const double tolerance : {0.5, 0.1, 0.02}) {
        const auto found =
            fewest_nodes(even, middle_track, 0.0, 1.0, {.tip = tolerance}, {.lattice = 1000}, {});
        ASSERT_TRUE(found.has_value());
        const double longest = std::sqrt(tolerance / 20.0);
        const auto moves = static_cast<double>(found->places.size() - 1);
        EXPECT_GE(moves, std::ceil(1.0 / longest - 1e-9));
        EXPECT_LE(moves, std::ceil(1.0 / (longest - 0.001))); // a lattice loses less than an interval a move
        EXPECT_EQ(found->places.front(), 0.0);
        EXPECT_EQ(found->places.back(), 1.0);
    }
}

TEST(FewestNodes, AreWithinTheToleranceByFineSampling) {
    const test::RandomErrorModel model(5, true); // fine sampling sees quite other errors
    const auto found =
        fewest_nodes(model, middle_track, 0.0, 1.0, {.tip = 0.6, .axis = 1.0}, {.lattice = 40}, {});
    if (found) {
        for (std::size_t n = 1; n < found->places.size(); ++n) {
            const MoveError move =
                model.move(middle_track.at(found->places[n - 1]), middle_track.at(found->places[n]), fine);
            EXPECT_LE(move.tip, 0.6);
        }
    }
    const SpikeErrorModel spike({});
    const auto on_spike = fewest_nodes(spike, middle_track, 0.0, 1.0, {.tip = 0.05}, {}, {});
    ASSERT_TRUE(on_spike.has_value());
    for (std::size_t n = 1; n < on_spike->places.size(); ++n) {
        EXPECT_LE(
            spike.move(middle_track.at(on_spike->places[n - 1]), middle_track.at(on_spike->places[n]), fine)
                .tip,
            0.05);
    }
}

// A track that one move can follow got three: longer moves were never tried.
TEST(FewestNodes, OfATrackThatOneMoveFollowsAreItsEnds) {
    const SpikeErrorModel even({.background = 20.0, .height = 0.0, .limit = 1e9});
    for (const auto& [tolerance, nodes] : {std::pair(20.5, 2U), std::pair(7.0, 3U)}) {
        const auto found = fewest_nodes(even, middle_track, 0.0, 1.0, {.tip = tolerance}, {}, {});
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(found->places.size(), nodes) << tolerance;
    }
}

/// The nodes of the shortest path over all moves of the lattice, each measured finely. 0 if there is none.
std::size_t fewest_by_force(const ErrorModel& model, double tolerance, int intervals) {
    const MoveTable all(model,
                        middle_track,
                        lattice(model, {middle_track, {0.0, 1.0}}, {.intervals = intervals}, {}),
                        {0.0, 1.0},
                        fine,
                        {});
    const auto best = shortest_path(all, {}, {.tip = tolerance});
    return best ? best->nodes.size() : 0;
}

std::size_t fewest_found(const ErrorModel& model, double tolerance, int intervals) {
    const auto found =
        fewest_nodes(model, middle_track, 0.0, 1.0, {.tip = tolerance}, {.lattice = intervals}, {});
    return found ? found->places.size() : 0;
}

TEST(FewestNodes, AreAsFewAsByForce) {
    const SpikeErrorModel spike({});
    for (const double tolerance : {0.02, 0.05, 0.2, 1.0, 5.0}) {
        EXPECT_EQ(fewest_found(spike, tolerance, 1000), fewest_by_force(spike, tolerance, 1000)) << tolerance;
    }
}

/// Sampling that is not fine sees moves across the middle wrongly by a factor.
class MisjudgedErrorModel final : public ClosedFormErrorModel {
public:
    explicit MisjudgedErrorModel(double factor) : factor_(factor) {}

    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling sampling) const override {
        const double h = (b - a).norm();
        const bool across = std::min(a.y(), b.y()) < 0.5 && std::max(a.y(), b.y()) > 0.5;
        const double seen = across && sampling != fine ? factor_ : 1.0;
        return {.tip = (across ? 30.0 : 20.0) * seen * h * h, .length = size * h};
    }

private:
    double factor_;
};

// Where the search saw too little, all moves were held to less; where it saw too much, good ones were lost.
TEST(FewestNodes, AreAsFewAsByForceWhereTheScreeningErrs) {
    for (const double factor : {0.4, 0.97, 1.2}) {
        const MisjudgedErrorModel model(factor);
        for (const double tolerance : {0.05, 0.3, 0.501}) {
            EXPECT_EQ(fewest_found(model, tolerance, 200), fewest_by_force(model, tolerance, 200))
                << factor << ", " << tolerance;
        }
    }
}

TEST(FewestNodes, AreNothingWhereTheLatticeIsTooCoarse) {
    const SpikeErrorModel spike({});
    EXPECT_FALSE(fewest_nodes(spike, middle_track, 0.0, 1.0, {.tip = 1e-6}, {.lattice = 50}, {}).has_value());
    EXPECT_THROW((void)fewest_nodes(spike, middle_track, 0.5, 0.5, {}, {}, {}), Defect);
    EXPECT_THROW((void)fewest_nodes(spike, middle_track, 0.0, 1.0, {}, {.lattice = 7}, {}), Defect);
}

} // namespace
} // namespace millwright::grid
