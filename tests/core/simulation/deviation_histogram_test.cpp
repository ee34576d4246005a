#include "core/simulation/deviation_histogram.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace millwright::simulation {
namespace {

std::vector<PartPoint> points_of(const std::vector<double>& areas) {
    std::vector<PartPoint> points;
    for (const double area : areas) {
        points.emplace_back().area = area;
    }
    return points;
}

std::vector<Deviation> deviations_of(const std::vector<double>& heights) {
    std::vector<Deviation> deviations;
    for (const double height : heights) {
        deviations.emplace_back().height = height;
    }
    return deviations;
}

TEST(DeviationHistogram, BinsAreSharesOfTheArea) {
    const auto points = points_of({1.0, 2.0, 3.0, 4.0});
    const auto found = histogram_of(points, deviations_of({-0.9, -0.1, 0.1, 0.9}), 1.0, 4);
    EXPECT_EQ(found.shares, (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
    EXPECT_DOUBLE_EQ(found.height(0), -0.75);
    EXPECT_DOUBLE_EQ(found.height(3), 0.75);
}

TEST(DeviationHistogram, WhatIsBeyondIsInTheBinsAtTheEnds) {
    const auto found = histogram_of(points_of({1.0, 1.0}), deviations_of({-9.0, 9.0}), 1.0, 3);
    EXPECT_EQ(found.shares, (std::vector<double>{0.5, 0.0, 0.5}));
    EXPECT_DOUBLE_EQ(std::accumulate(found.shares.begin(), found.shares.end(), 0.0), 1.0);
}

TEST(DeviationHistogram, TheRangeIsRoundAndHoldsNearlyAll) {
    std::vector<double> heights(99, 0.03);
    heights.push_back(50.0);
    EXPECT_DOUBLE_EQ(histogram_range(deviations_of(heights), 0.01), 0.05);
    EXPECT_DOUBLE_EQ(histogram_range(deviations_of(heights), 0.1), 0.2) << "twice the tolerance";
    EXPECT_DOUBLE_EQ(histogram_range({}, 0.0), 1e-3);
}

TEST(DeviationHistogram, EveryPointNeedsADeviation) {
    EXPECT_THROW((void)histogram_of(points_of({1.0}), {}, 1.0, 3), Defect);
    EXPECT_THROW((void)histogram_of({}, {}, 0.0, 3), Defect);
}

} // namespace
} // namespace millwright::simulation
