#include "core/plot/ordering.h"

#include "core/base/numbers.h"

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

/// Way across at rapid of the path that is cut.
double rapid(const Strokes& strokes, const CutSettings& cut) {
    double way = 0.0;
    Vec2 at = Vec2::Zero();
    for (const CutPoint& point : cut_path(strokes, cut)) {
        const Vec2 to = point.at.head<2>();
        way += exactly_equal(point.speed, 0.0) ? (to - at).norm() : 0.0;
        at = to;
    }
    return way;
}

// Pens were put into the order in which they first draw, and then cut in another one.
TEST(StrokeOrdering, IsNeverLongerThanTheFileWhereLevelsHaveAnOrderOfTheirOwn) {
    int shorter = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const int pens = 1 + static_cast<int>(seed % 3);
        const Strokes strokes = random_strokes(2 + static_cast<int>(seed % 11), seed, pens);
        CutSettings cut;
        cut.levels = levels_for(strokes);
        cut.levels.back().order = -5;
        cut.levels.back().passes = 1 + static_cast<int>(seed % 2);
        cut.levels.front().tool = 1 + static_cast<int>(seed % 5 == 0);
        if (seed % 4 == 0) { // a pen once more behind the others
            cut.levels.push_back(cut.levels.back());
            cut.levels.back().order = 9;
        }
        if (seed % 7 == 0) {
            cut.levels.front().enabled = false;
        }
        const Vec2 end = seed % 2 == 0 ? Vec2(Vec2::Zero()) : strokes.back().points.back();
        const Strokes found = ordered(strokes, cut, Vec2::Zero(), end);
        EXPECT_LE(rapid(found, cut), rapid(strokes, cut) + 1e-9) << seed;
        EXPECT_EQ(found.size(), strokes.size());
        shorter += rapid(found, cut) < rapid(strokes, cut) - 1.0 ? 1 : 0;
    }
    EXPECT_GT(shorter, 100);
}

TEST(StrokeOrdering, PensComeAsTheyAreCut) {
    const Strokes strokes = random_strokes(60, 5, 3);
    CutSettings cut;
    cut.levels = levels_for(strokes);
    cut.levels[2].order = -1;
    std::vector<int> pens;
    for (const Stroke& stroke : ordered(strokes, cut)) {
        pens.push_back(stroke.pen);
    }
    pens.erase(std::unique(pens.begin(), pens.end()), pens.end());
    EXPECT_EQ(pens, (std::vector<int>{3, 1, 2}));
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

Stroke ring_of(const Vec2& centre, double size, int first, int byte) {
    std::vector<Vec2> corners = {
        centre, centre + Vec2(size, 0.0), centre + Vec2(size, size), centre + Vec2(0.0, size)};
    std::ranges::rotate(corners, corners.begin() + first);
    corners.push_back(corners.front());
    return {.pen = 1, .points = corners, .byte = byte};
}

Strokes random_squares(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, 100.0);
    Strokes squares;
    for (int n = 0; n < count; ++n) {
        const double x = coordinate(random), y = coordinate(random);
        squares.push_back(ring_of({x, y}, 5.0 + coordinate(random) / 4.0, static_cast<int>(random() % 4), n));
    }
    return squares;
}

TEST(StrokeOrdering, BeginsClosedStrokesWhereTheToolIsNearest) {
    // Both squares begin at their far corner; the tool comes along x from the origin and goes home.
    const Strokes found = ordered({ring_of({10.0, 0.0}, 10.0, 2, 0), ring_of({30.0, 0.0}, 10.0, 2, 1)});
    EXPECT_NEAR(air(found), 60.0, 1e-9); // to x = 30 at the most and back, whichever is cut on the way
    for (const Stroke& stroke : found) {
        EXPECT_EQ(stroke.points.front(), stroke.points.back());
        EXPECT_EQ(stroke.points.size(), 5U);
    }
}

TEST(StrokeOrdering, KeepsClosedStrokesAndTheirSense) {
    const Strokes squares = random_squares(40, 7);
    const Strokes found = ordered(squares);
    EXPECT_LT(air(found), air(squares));
    for (const Stroke& stroke : found) {
        std::vector<Vec2> original = squares[static_cast<std::size_t>(stroke.byte)].points;
        original.pop_back();
        const auto first = std::ranges::find(original, stroke.points.front());
        ASSERT_NE(first, original.end());
        std::ranges::rotate(original, first);
        original.push_back(original.front());
        EXPECT_EQ(stroke.points, original);
    }
}

// All orders and beginnings of four squares by brute force.
TEST(StrokeOrdering, ComesNearTheBestOrderAndBeginningsOfClosedStrokes) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const Strokes squares = random_squares(4, seed);
        std::vector<std::size_t> order = {0, 1, 2, 3};
        double best = air(squares);
        do {
            for (unsigned begins = 0; begins < 256; ++begins) {
                Vec2 at = Vec2::Zero();
                double way = 0.0;
                for (const std::size_t n : order) {
                    const Vec2& corner = squares[n].points[begins >> (2 * n) & 3U];
                    way += (corner - at).norm();
                    at = corner;
                }
                best = std::min(best, way + at.norm());
            }
        } while (std::ranges::next_permutation(order).found);
        EXPECT_LE(air(ordered(squares)), 1.1 * best) << seed;
        EXPECT_GE(air(ordered(squares)), best - 1e-9) << seed;
    }
}

TEST(StrokeOrdering, IsNeverLongerToAnEndElsewhere) {
    const Vec2 end(300.0, 300.0);
    for (unsigned seed = 0; seed < 20; ++seed) {
        Strokes strokes = random_strokes(5, seed);
        for (const Stroke& square : random_squares(4, seed)) {
            strokes.push_back(square);
        }
        EXPECT_LE(air_length(ordered(strokes, Vec2::Zero(), end), Vec2::Zero(), end),
                  air_length(strokes, Vec2::Zero(), end) + 1e-9);
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
