#include "core/geometry/trim.h"

#include "tests/support/trim_loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::geometry {
namespace {

using test::rectangle;

Trim::Loop circle_of_400(const Vec2& middle, double radius, int corners = 400) {
    return test::circle(middle, radius, corners);
}

TEST(Trim, WithoutLoopsIsEverything) {
    const Trim trim;
    EXPECT_TRUE(trim.contains({0.0, 1.0}));
    const auto parts = parts_inside(trim, {0.1, 0.1}, {0.9, 0.2});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].from, 0.0);
    EXPECT_EQ(parts[0].to, 1.0);
}

TEST(Trim, AHoleDoesNotBelongToIt) {
    const Trim trim{{circle_of_400({0.5, 0.5}, 0.4), circle_of_400({0.5, 0.5}, 0.2)}};
    EXPECT_TRUE(trim.contains({0.5, 0.8}));
    EXPECT_FALSE(trim.contains({0.5, 0.5}));
    EXPECT_FALSE(trim.contains({0.05, 0.05}));
    const auto parts = parts_inside(trim, {0.0, 0.5}, {1.0, 0.5});
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_NEAR(parts[0].from, 0.1, 1e-4);
    EXPECT_NEAR(parts[0].to, 0.3, 1e-4);
    EXPECT_NEAR(parts[1].from, 0.7, 1e-4);
    EXPECT_NEAR(parts[1].to, 0.9, 1e-4);
}

TEST(Trim, PartsAreWhereTheirPlacesAreInside) {
    const Trim trim{{circle_of_400({0.4, 0.5}, 0.35), rectangle(0.2, 0.45, 0.6, 0.6)}};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    for (int n = 0; n < 300; ++n) {
        const Vec2 a(place(random), place(random));
        const Vec2 b(place(random), place(random));
        const auto parts = parts_inside(trim, a, b);
        for (int k = 0; k < 200; ++k) {
            const double t = (k + 0.5) / 200.0;
            const Vec2 at = a + t * (b - a);
            const bool in_part =
                std::ranges::any_of(parts, [&](const WayPart& p) { return t > p.from && t < p.to; });
            const bool near_border = std::ranges::any_of(parts, [&](const WayPart& p) {
                return std::abs(t - p.from) < 1e-5 || std::abs(t - p.to) < 1e-5;
            });
            EXPECT_TRUE(near_border || in_part == trim.contains(at));
        }
    }
}

TEST(Trim, TheBorderOfThePatchBelongsToWhatIsBesideIt) {
    const Trim trim{{rectangle(0.0, 0.0, 1.0, 0.5)}};
    EXPECT_TRUE(trim.contains({0.0, 0.0}));
    EXPECT_TRUE(trim.contains({1.0, 0.25}));
    EXPECT_FALSE(trim.contains({1.0, 0.75}));
    const auto parts = parts_inside(trim, {1.0, 0.0}, {1.0, 1.0});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_NEAR(parts[0].to, 0.5, 1e-9);
}

TEST(Trim, InASquareOfARaster) {
    const Trim::Loop outline = rectangle(0.5, 0.5, 2.5, 1.5);
    const auto corner = trim_in_square({outline}, {0, 0});
    ASSERT_TRUE(corner);
    EXPECT_TRUE(corner->contains({0.75, 0.75}));
    EXPECT_FALSE(corner->contains({0.25, 0.75}));
    const auto whole = trim_in_square({rectangle(-1, -1, 3, 3)}, {1, 1});
    ASSERT_TRUE(whole);
    EXPECT_TRUE(whole->everything());
    EXPECT_FALSE(trim_in_square({outline}, {3, 0}));
    EXPECT_FALSE(trim_in_square({rectangle(-1, -1, 3, 3), rectangle(0, 0, 1, 1)}, {0, 0})) << "all hole";
}

/// What the square cuts in two hangs together along its side, where nothing is inside.
TEST(Trim, PartsAlongTheSideOfASquareAreTwo) {
    const Trim::Loop horseshoe{
        {0.2, 0.1}, {1.8, 0.1}, {1.8, 0.9}, {0.2, 0.9}, {0.2, 0.7}, {1.5, 0.7}, {1.5, 0.3}, {0.2, 0.3}};
    const auto trim = trim_in_square({horseshoe}, {0, 0});
    ASSERT_TRUE(trim);
    EXPECT_FALSE(trim->contains({1.0, 0.5}));
    EXPECT_TRUE(trim->contains({1.0, 0.2}));
    EXPECT_EQ(parts_inside(*trim, {1.0, 0.0}, {1.0, 1.0}).size(), 2U);
}

} // namespace
} // namespace millwright::geometry
