#include "core/base/error.h"
#include "core/grid/track.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace millwright::grid {
namespace {

const Track across_the_spike{TrackDirection::along_v, 0.48};

TEST(EqualShares, OfAConstantDensityAreEquallySpaced) {
    const std::vector<double> density(7, 2.5);
    const std::vector<double> places = equal_shares(density, 0.2, 0.7, 10);
    ASSERT_EQ(places.size(), 11U);
    for (std::size_t n = 0; n < places.size(); ++n) {
        EXPECT_NEAR(places[n], 0.2 + 0.05 * static_cast<double>(n), 1e-14);
    }
    EXPECT_EQ(places.front(), 0.2);
    EXPECT_EQ(places.back(), 0.7);
}

TEST(EqualShares, FollowTheDensity) {
    // Three times the density in the second half: a quarter of the shares in the first.
    const std::vector<double> density{1.0, 1.0, 3.0, 3.0};
    const std::vector<double> places = equal_shares(density, 0.0, 1.0, 8);
    EXPECT_NEAR(places[2], 0.5, 1e-14);
    EXPECT_NEAR(places[1], 0.25, 1e-14);
    EXPECT_NEAR(places[5], 0.75, 1e-14);
}

TEST(EqualShares, OfADensityThatIsNotPositiveAreADefect) {
    EXPECT_THROW((void)equal_shares(std::vector<double>{1.0, 0.0}, 0.0, 1.0, 4), Defect);
    EXPECT_THROW((void)equal_shares(std::vector<double>{}, 0.0, 1.0, 4), Defect);
}

TEST(Through, PutsEveryNodeIntoThePlaces) {
    const std::vector<double> places{0.0, 0.25, 0.5, 0.75, 1.0};
    const std::vector<double> nodes{0.0, 0.3, 0.31, 0.7, 1.0};
    EXPECT_EQ(through(places, nodes), (std::vector<double>{0.0, 0.3, 0.31, 0.5, 0.7, 1.0}));
}

TEST(Monitor, HasMeanOneAndItsTopAtTheSpike) {
    const SpikeErrorModel model({});
    const std::vector<double> found = monitor(model, across_the_spike, 0.0, 1.0, 100, 3, {});
    EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0) / 100.0, 1.0, 1e-12);
    const auto top = std::ranges::max_element(found) - found.begin();
    EXPECT_NEAR(static_cast<double>(top) / 100.0, 0.52, 0.02);
}

TEST(Monitor, IsOneWhereThereIsNoErrorAtAll) {
    const SpikeErrorModel model({.background = 0.0, .height = 0.0});
    for (const double value : monitor(model, across_the_spike, 0.0, 1.0, 20, 3, {})) {
        EXPECT_EQ(value, 1.0);
    }
}

TEST(Monitor, IsProportionalToTheRootOfTheCurvatureOfTheError) {
    // kappa(v) = height / (1 + (v - 0.52)^2 / width^2) on the track through the spike; e = kappa h^2.
    const SpikeErrorModel model({.background = 0.0, .height = 100.0, .width = 0.2, .limit = 1e9});
    const std::vector<double> found = monitor(model, across_the_spike, 0.0, 1.0, 400, 0, {});
    const auto root = [](double v) { return 1.0 / std::sqrt(1.0 + square((v - 0.52) / 0.2)); };
    EXPECT_NEAR(found[40] / found[300], root(40.5 / 400) / root(300.5 / 400), 0.01);
}

TEST(Lattice, HoldsTheNodesOfTheStartAndAscends) {
    const SpikeErrorModel model({});
    const PlacedTrack start{across_the_spike, {0.0, 0.111, 0.44, 0.441, 0.83, 1.0}};
    const std::vector<double> places = lattice(model, start, {.intervals = 50}, {});
    EXPECT_TRUE(std::ranges::is_sorted(places, std::ranges::less_equal{})) << "strictly";
    EXPECT_TRUE(std::ranges::includes(places, start.places));
    EXPECT_GE(std::ssize(places), 51);
    EXPECT_LE(std::ssize(places), 52);
}

TEST(Lattice, IsDenserAtTheSpikeButNowhereEmpty) {
    const SpikeErrorModel model({});
    const PlacedTrack start{across_the_spike, {0.0, 1.0}};
    const std::vector<double> places = lattice(model, start, {.intervals = 200}, {});
    const auto in = [&](double from, double to) {
        return std::ranges::count_if(places, [&](double s) { return s >= from && s < to; });
    };
    EXPECT_GT(in(0.47, 0.57), 2 * in(0.0, 0.1));
    EXPECT_GE(in(0.0, 0.1), 8) << "half of the density is uniform: 10 a tenth, with equal shares";
}

} // namespace
} // namespace millwright::grid
