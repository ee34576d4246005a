#include "core/base/error.h"
#include "core/grid/track_candidates.h"
#include "tests/core/grid/short_names.h"

#include <gtest/gtest.h>

#include <random>

namespace millwright::grid {
namespace {

using test::infinity;

/// The least sum over all choices, by trying them all.
double least_sum(const std::vector<double>& costs, int at, int left, int nearest, int furthest) {
    const int last = static_cast<int>(costs.size()) - 1;
    if (left == 0) {
        return at == last ? costs.back() : infinity;
    }
    double least = infinity;
    for (int next = at + nearest; next <= std::min(last, at + furthest); ++next) {
        least = std::min(least, least_sum(costs, next, left - 1, nearest, furthest));
    }
    return least + costs[static_cast<std::size_t>(at)];
}

TEST(CheapestChoice, IsTheBestOfAllChoices) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> cost(0.0, 1.0);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> costs(13);
        for (double& c : costs) {
            c = cost(random) < 0.1 ? infinity : cost(random);
        }
        const auto chosen = cheapest_choice(costs, 5, 2, 4);
        const double least = least_sum(costs, 0, 4, 2, 4);
        ASSERT_EQ(chosen.has_value(), least < infinity);
        if (!chosen) {
            continue;
        }
        ASSERT_EQ(chosen->size(), 5U);
        EXPECT_EQ(chosen->front(), 0);
        EXPECT_EQ(chosen->back(), 12);
        double sum = costs[0];
        for (std::size_t n = 1; n < chosen->size(); ++n) {
            const int apart = (*chosen)[n] - (*chosen)[n - 1];
            EXPECT_TRUE(apart >= 2 && apart <= 4);
            sum += costs[static_cast<std::size_t>((*chosen)[n])];
        }
        EXPECT_NEAR(sum, least, 1e-12);
    }
}

TEST(CheapestChoice, IsNothingWhereTheDistancesCannotBeKept) {
    const std::vector<double> costs(10, 1.0);
    EXPECT_FALSE(cheapest_choice(costs, 3, 5, 6).has_value());
    EXPECT_FALSE(cheapest_choice(costs, 3, 1, 4).has_value());
    EXPECT_FALSE(cheapest_choice({}, 2, 1, 2).has_value());
    EXPECT_THROW((void)cheapest_choice(costs, 1, 1, 2), Defect);
    EXPECT_THROW((void)cheapest_choice(costs, 3, 3, 2), Defect);
}

} // namespace
} // namespace millwright::grid
