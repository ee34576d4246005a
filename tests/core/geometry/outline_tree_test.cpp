#include "core/geometry/outline_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::geometry {
namespace {

/// Loops of any shape: they cross themselves and each other, leave the patch, and have corners on its border,
/// on each other's heights and twice at one place.
Trim random_outlines(std::mt19937& random) {
    std::uniform_real_distribution<double> anywhere(-0.2, 1.2);
    std::uniform_int_distribution<int> count(3, 60), loops(1, 4), kind(0, 3), tenth(0, 10);
    Trim trim;
    for (int loop = loops(random); loop > 0; --loop) {
        Trim::Loop corners;
        for (int n = count(random); n > 0; --n) {
            const bool rough = kind(random) == 0;
            corners.emplace_back(rough ? 0.1 * tenth(random) : anywhere(random),
                                 rough ? 0.1 * tenth(random) : anywhere(random));
        }
        trim.loops.push_back(corners);
    }
    return trim;
}

/// Any way, along u, along v, or along a line of the outlines' own places.
std::pair<Vec2, Vec2> random_way(std::mt19937& random) {
    std::uniform_real_distribution<double> anywhere(0.0, 1.0);
    std::uniform_int_distribution<int> kind(0, 4), tenth(0, 10);
    Vec2 a(anywhere(random), anywhere(random)), b(anywhere(random), anywhere(random));
    const int which = kind(random);
    if (which == 1 || which == 2) { // straight along one parameter
        b[which - 1] = a[which - 1];
    } else if (which == 3) { // through corners, along edges and borders
        a = 0.1 * Vec2(tenth(random), tenth(random));
        b = 0.1 * Vec2(tenth(random), tenth(random));
    }
    return {a, b};
}

void expect_same(const std::vector<WayPart>& parts, const std::vector<WayPart>& expected) {
    ASSERT_EQ(parts.size(), expected.size());
    for (std::size_t n = 0; n < parts.size(); ++n) {
        EXPECT_EQ(parts[n].from, expected[n].from);
        EXPECT_EQ(parts[n].to, expected[n].to);
    }
}

/// Teeth whose corners all lie between v = 0.49 and v = 0.51, and the patch above them.
Trim saw(int corners) {
    Trim::Loop loop;
    for (int n = 0; n < corners; ++n) {
        loop.emplace_back(0.05 + 0.9 * n / (corners - 1), n % 2 == 0 ? 0.49 : 0.51);
    }
    loop.emplace_back(0.95, 0.95);
    loop.emplace_back(0.05, 0.95);
    return {{loop}};
}

TEST(OutlineTree, AnswersAsTheOutlinesThemselvesWhereverTheyRun) {
    std::mt19937 random(4711);
    std::size_t pieces = 0;
    for (int round = 0; round < 300; ++round) {
        const Trim trim = random_outlines(random);
        const OutlineTree tree(trim);
        for (int n = 0; n < 30; ++n) {
            const auto [a, b] = random_way(random);
            EXPECT_EQ(tree.contains(a), trim.contains(a)) << a.transpose();
            const auto expected = parts_inside(trim, a, b);
            expect_same(tree.parts_inside(a, b), expected);
            pieces += expected.size();
        }
    }
    EXPECT_GT(pieces, 10'000U) << "most ways are cut into several";
}

TEST(OutlineTree, AWayAlongAllTeethOfASawHasAPartInEach) {
    const Trim trim = saw(2'000);
    const Vec2 a(0.0, 0.5), b(1.0, 0.5);
    const auto parts = OutlineTree(trim).parts_inside(a, b);
    expect_same(parts, parts_inside(trim, a, b));
    ASSERT_EQ(parts.size(), 1'000U); // half of each tooth is cut, that of the two ends once
    double sum = 0.0;
    for (const WayPart& part : parts) {
        sum += part.to - part.from;
    }
    EXPECT_NEAR(sum, 0.45, 1e-3);
}

TEST(OutlineTree, WithoutOutlinesThereIsEverything) {
    const OutlineTree tree(Trim{});
    EXPECT_TRUE(tree.contains({0.3, 0.9}));
    expect_same(tree.parts_inside({0.0, 0.0}, {1.0, 1.0}), {{0.0, 1.0}});
}

TEST(OutlineTree, EveryCornerOfAHundredThousandIsAskedAbout) {
    const Trim trim = saw(most_trim_corners - 2); // 20 s where each part looks at every edge
    const auto parts = OutlineTree(trim).parts_inside({0.0, 0.5}, {1.0, 0.5});
    EXPECT_EQ(parts.size(), 49'999U);
}

} // namespace
} // namespace millwright::geometry
