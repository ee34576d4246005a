#include "core/toolpath/internal/chord_curve.h"

#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::toolpath {
namespace {

/// A random walk, some of whose chords have no length.
std::vector<Vec3> walk(std::mt19937& random, std::size_t points) {
    std::uniform_real_distribution<double> step(-1.0, 1.0);
    std::vector<Vec3> found{Vec3::Zero()};
    while (found.size() < points) {
        const bool stays = found.size() % 7 == 3;
        found.push_back(found.back() +
                        (stays ? Vec3(Vec3::Zero()) : Vec3(step(random), step(random), step(random))));
    }
    return found;
}

double distance_to_chord(const Vec3& a, const Vec3& b, const Vec3& p) {
    const double square = (b - a).squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
    return (a + s * (b - a) - p).norm();
}

TEST(ChordCurve, FindsTheNearestOfAllChords) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-6.0, 6.0);
    for (const std::size_t points : {2U, 3U, 16U, 17U, 18U, 33U, 201U}) {
        const std::vector<Vec3> line = walk(random, points);
        const ChordCurve curve(line, line); // normals that tell the place
        for (int n = 0; n < 200; ++n) {
            const Vec3 p(anywhere(random), anywhere(random), anywhere(random));
            double least = distance_to_chord(line[0], line[1], p);
            for (std::size_t k = 2; k < points; ++k) {
                least = std::min(least, distance_to_chord(line[k - 1], line[k], p));
            }
            const auto found = curve.nearest(p);
            EXPECT_NEAR(std::sqrt(found.squared), least, 1e-12) << points;
            EXPECT_NEAR((found.point - p).norm(), least, 1e-12) << points;
            EXPECT_NEAR((found.normal - found.point).norm(), 0.0, 1e-12) << points;
        }
    }
}

TEST(ChordCurve, IsBesideAPointNeverNearerThanItsNearestChord) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> anywhere(-6.0, 6.0);
    const std::vector<Vec3> line = walk(random, 60);
    const ChordCurve curve(line, line);
    for (std::size_t n = 0; n < 200; ++n) {
        const Vec3 p(anywhere(random), anywhere(random), anywhere(random));
        EXPECT_GE(curve.squared_beside(p, n), curve.nearest(p).squared);
    }
    for (std::size_t n = 0; n < line.size(); ++n) {
        EXPECT_EQ(curve.squared_beside(line[n], n), 0.0);
    }
}

TEST(ChordCurve, OfAPointThatIsNoneFindsNothing) {
    const ChordCurve curve({Vec3::Zero(), Vec3::UnitX()}, {Vec3::UnitZ(), Vec3::UnitZ()});
    const double nan = std::nan("");
    const test::WithoutTraps comparing_none;
    EXPECT_TRUE(std::isinf(curve.nearest({nan, 0.0, 0.0}).squared));
}

TEST(ChordCurve, GoesEvenlyFromChordToChord) {
    const ChordCurve curve({Vec3::Zero(), Vec3(1, 0, 0), Vec3(1, 4, 0)}, std::vector<Vec3>(3, Vec3::UnitZ()));
    EXPECT_DOUBLE_EQ(curve.length(), 5.0);
    EXPECT_EQ(curve.at(0.0), Vec3(0, 0, 0));
    EXPECT_EQ(curve.at(0.25), Vec3(0.5, 0, 0));
    EXPECT_EQ(curve.at(0.75), Vec3(1, 2, 0));
    EXPECT_EQ(curve.at(1.0), Vec3(1, 4, 0));
}

} // namespace
} // namespace millwright::toolpath
