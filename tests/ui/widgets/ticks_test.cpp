#include "ui/widgets/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace millwright::widgets {
namespace {

TEST(Ticks, AreRoundNumbersInsideTheRange) {
    const Ticks found = ticks(0.0, 1.0, 6);
    EXPECT_EQ(found.values, (std::vector<double>{0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
    EXPECT_EQ(found.decimals, 1);
    EXPECT_EQ(ticks(-3.0, 12.0, 5).values, (std::vector<double>{0.0, 5.0, 10.0}));
}

TEST(Ticks, ReadAsTheyAreMeant) {
    const Ticks found = ticks(0.0, 0.35, 8);
    ASSERT_EQ(found.values.size(), 8U);
    EXPECT_EQ(tick_text(found.values[3], found), "0.15");
    EXPECT_EQ(tick_text(found.values[6], found), "0.30");
    EXPECT_EQ(tick_text(2e9, ticks(0.0, 4e9, 5)), "2e+09");
}

TEST(Ticks, AnyRangeHasAtMostAsManyAsAskedEvenlySpaced) {
    std::mt19937 random(1997);
    std::uniform_real_distribution<double> exponent(-12.0, 12.0);
    std::uniform_real_distribution<double> sign(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double low = sign(random) * std::pow(10.0, exponent(random));
        const double span = std::pow(10.0, exponent(random));
        const double high = low + span;
        for (const int at_most : {2, 5, 9}) {
            const auto values = ticks(low, high, at_most).values;
            ASSERT_LE(std::ssize(values), at_most);
            if (at_most >= 5 && span > 1e-6 * std::abs(low)) {
                ASSERT_GE(std::ssize(values), 2) << low << " " << high;
            }
            for (std::size_t k = 0; k + 1 < values.size(); ++k) {
                ASSERT_LE(low, values[k]);
                ASSERT_LE(values[k + 1], high);
                ASSERT_NEAR((values[k + 1] - values[k]) / (values[1] - values[0]), 1.0, 1e-5);
            }
        }
    }
}

TEST(Ticks, OneAloneIsNotLeftOnAnAxis) {
    constexpr double error_mm = 0.0435; // in a low pane; the only tick was 0.00
    const Ticks found = scale_ticks(0.0, error_mm, 2);
    EXPECT_EQ(found.values, (std::vector<double>{0.0, 0.02, 0.04}));
    EXPECT_EQ(tick_text(found.values[1], found), "0.02");
    for (int i = 1; i < 400; ++i) {
        for (const double low : {0.0, 0.37, -1.9}) {
            const double span = std::pow(10.0, -4.0 + 0.02 * i);
            ASSERT_GE(std::ssize(scale_ticks(low, low + span, 2).values), 2) << low << " " << span;
        }
    }
    EXPECT_EQ(scale_ticks(0.0, 1.0, 6).values, ticks(0.0, 1.0, 6).values);
    EXPECT_TRUE(scale_ticks(1.0, 1.0, 2).values.empty());
}

TEST(Ticks, NoRangeHasNoTicks) {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(ticks(1.0, 1.0, 5).values.empty());
    EXPECT_TRUE(ticks(2.0, 1.0, 5).values.empty());
    EXPECT_TRUE(ticks(0.0, inf, 5).values.empty());
    EXPECT_TRUE(ticks(nan, 1.0, 5).values.empty());
    EXPECT_TRUE(ticks(-1.7e308, 1.7e308, 5).values.empty());
    EXPECT_TRUE(ticks(0.0, 1.0, 0).values.empty());
}

TEST(Ticks, ARangeNarrowerThanNumbersResolveEnds) {
    EXPECT_LE(std::ssize(ticks(1e15, std::nextafter(1e15, 2e15), 5).values), 5);
    EXPECT_TRUE(ticks(0.0, 5e-324, 5).values.empty());
}

} // namespace
} // namespace millwright::widgets
