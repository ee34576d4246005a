#include "core/plot/ordering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

namespace millwright::plot {
namespace {

Strokes random_strokes(int count, unsigned seed, int pens = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, 300.0);
    std::uniform_real_distribution<double> step(-5.0, 5.0);
    Strokes strokes;
    for (int n = 0; n < count; ++n) {
        const Vec2 at(coordinate(random), coordinate(random));
        strokes.push_back(
            {.pen = 1 + n % pens,
             .points = {at, at + Vec2(step(random), step(random)), at + Vec2(step(random), step(random))},
             .byte = n});
    }
    return strokes;
}

double air(const Strokes& strokes) {
    return air_length(strokes, Vec2::Zero(), Vec2::Zero());
}

TEST(StrokeOrdering, KeepsEveryStrokePerhapsReversed) {
    const Strokes strokes = random_strokes(300, 1, 3);
    Strokes found = ordered(strokes);
    ASSERT_EQ(found.size(), strokes.size());
    for (const Stroke& stroke : found) {
        const Stroke& original = strokes[static_cast<std::size_t>(stroke.byte)];
        std::vector<Vec2> reversed = original.points;
        std::ranges::reverse(reversed);
        EXPECT_EQ(stroke.pen, original.pen);
        EXPECT_TRUE(stroke.points == original.points || stroke.points == reversed);
    }
    std::ranges::sort(found, {}, &Stroke::byte);
    EXPECT_EQ(std::ranges::unique(found, {}, &Stroke::byte).size(), 0U);
    EXPECT_TRUE(std::ranges::is_sorted(ordered(strokes), {}, &Stroke::pen));
}

TEST(StrokeOrdering, IsNeverLongerThanTheFile) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Strokes strokes =
            random_strokes(1 + static_cast<int>(seed % 9), seed, 1 + static_cast<int>(seed % 3));
        EXPECT_LE(air(ordered(strokes)), air(strokes) + 1e-9) << seed;
        const Strokes again = ordered(ordered(strokes));
        EXPECT_LE(air(again), air(ordered(strokes)) + 1e-9) << seed;
    }
    EXPECT_TRUE(ordered({}).empty());
}

// All orders and directions of six strokes by brute force: 2-opt is within a quarter of the best.
TEST(StrokeOrdering, ComesNearTheBestOrder) {
    for (unsigned seed = 100; seed < 110; ++seed) {
        const Strokes strokes = random_strokes(6, seed);
        std::vector<int> order = {0, 1, 2, 3, 4, 5};
        double best = air(strokes);
        do {
            for (unsigned turned = 0; turned < 64; ++turned) {
                Strokes candidate;
                for (const int n : order) {
                    candidate.push_back(strokes[static_cast<std::size_t>(n)]);
                    if ((turned >> n & 1U) != 0) {
                        std::ranges::reverse(candidate.back().points);
                    }
                }
                best = std::min(best, air(candidate));
            }
        } while (std::ranges::next_permutation(order).found);
        EXPECT_LE(air(ordered(strokes)), 1.25 * best) << seed;
        EXPECT_GE(air(ordered(strokes)), best - 1e-9) << seed;
    }
}

TEST(StrokeOrdering, CutsTheTravelOfAScatteredDrawing) {
    const Strokes strokes = random_strokes(3000, 7);
    EXPECT_LT(air(ordered(strokes)), 0.05 * air(strokes));
}

TEST(StrokeOrdering, GivesTheSameOrderAgain) {
    const Strokes strokes = random_strokes(500, 3);
    EXPECT_EQ(ordered(strokes), ordered(strokes));
}

} // namespace
} // namespace millwright::plot
