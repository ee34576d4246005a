#include "core/geometry/closest_point.h"

#include "core/geometry/patch_refinement.h"
#include "core/geometry/presets.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace millwright::geometry {
namespace {

BezierPatch dome() {
    return surface_preset("dome").make().patch(PatchId{0});
}

double brute_force_distance(const BezierPatch& patch, const Vec3& point) {
    double best = 1e300;
    constexpr int side = 400;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const Vec3 s = patch.position(static_cast<double>(i) / side, static_cast<double>(j) / side);
            best = std::min(best, (s - point).norm());
        }
    }
    return best;
}

TEST(ClosestPoint, ReturnsToThePointItWasOffsetFromAlongTheNormal) {
    const BezierPatch patch = dome();
    const ClosestPointSearch search(patch);
    for (const double u : {0.1, 0.4, 0.73}) {
        for (const double v : {0.2, 0.5, 0.9}) {
            const Vec3 on = patch.position(u, v);
            const Vec3 off = on + 1.5 * patch.unit_normal(u, v).value();
            const ClosestPoint found = search.closest(off);
            EXPECT_NEAR(found.distance, 1.5, 1e-10);
            EXPECT_LT((found.position - on).norm(), 1e-8);
        }
    }
}

TEST(ClosestPoint, IsNeverFartherThanABruteForceSearch) {
    const BezierPatch patch = dome();
    const ClosestPointSearch search(patch);
    std::mt19937 random(1997);
    std::uniform_real_distribution<double> coordinate(-20.0, 120.0);
    for (int n = 0; n < 40; ++n) {
        const Vec3 point(coordinate(random), coordinate(random), coordinate(random));
        const ClosestPoint found = search.closest(point, {0.5, 0.5});
        EXPECT_LE(found.distance, brute_force_distance(patch, point) + 1e-12);
        EXPECT_NEAR((patch.position(found.parameters.x(), found.parameters.y()) - point).norm(),
                    found.distance,
                    1e-12);
    }
}

/// Control points at random heights: from a point between the hills there are many minima.
BezierPatch wild(int points, unsigned seed) {
    ControlNet net = ControlNet::sized(points, points);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> height(-60.0, 60.0);
    for (int i = 0; i < points; ++i) {
        for (int j = 0; j < points; ++j) {
            net.point(i, j) = {80.0 * i / (points - 1.0), 80.0 * j / (points - 1.0), height(random)};
        }
    }
    return BezierPatch(net);
}

std::vector<Vec3> fine_raster(const BezierPatch& patch) {
    constexpr int side = 400;
    std::vector<Vec3> points;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            points.push_back(patch.position(static_cast<double>(i) / side, static_cast<double>(j) / side));
        }
    }
    return points;
}

double least_distance(const std::vector<Vec3>& points, const Vec3& from) {
    double squared = 1e300;
    for (const Vec3& point : points) {
        squared = std::min(squared, (point - from).squaredNorm());
    }
    return std::sqrt(squared);
}

// From the nearest of 49 x 49 samples alone the descent ended in another hollow.
TEST(ClosestPoint, IsTheNearestOfAWildNetToo) {
    for (const auto& [points, seed] : {std::pair(8, 1U), std::pair(20, 2U), std::pair(40, 3U)}) {
        const BezierPatch patch = wild(points, seed);
        const ClosestPointSearch search(patch);
        const std::vector<Vec3> raster = fine_raster(patch);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> across(0.0, 80.0), height(-60.0, 60.0), guess(0.0, 1.0);
        for (int n = 0; n < 100; ++n) {
            const Vec3 point(across(random), across(random), height(random));
            const double by_force = least_distance(raster, point);
            for (const ClosestPoint& found :
                 {search.closest(point), search.closest(point, {guess(random), guess(random)})}) {
                EXPECT_LE(found.distance, by_force + 1e-12) << points << " points, try " << n;
                // A place of the patch, so that no nearer one is made up.
                const Vec3 there = patch.position(found.parameters.x(), found.parameters.y());
                EXPECT_LT((found.position - there).norm(), 1e-9);
                EXPECT_NEAR(found.distance, (point - there).norm(), 1e-9);
            }
        }
    }
}

/// Weights of 1e6 and 1e-6 in turn: near its corners half of the surface is within 1e-12 of the parameters.
BezierPatch uneven(int points, unsigned seed) {
    ControlNet net = wild(points, seed).net();
    for (int i = 0; i < points; ++i) {
        for (int j = 0; j < points; ++j) {
            net.weight(i, j) = (i + j) % 2 == 0 ? 1e6 : 1e-6;
        }
    }
    return BezierPatch(net);
}

/// A place of the surface that the parameters may be too coarse for: the middle of what is left when its
/// longer half is cut away again and again, at random.
Vec3 place_of(BezierPatch patch, std::mt19937& random) {
    std::bernoulli_distribution coin(0.5), mostly(0.9);
    const bool toward_u = coin(random), toward_v = coin(random);
    for (int n = std::uniform_int_distribution<int>(0, 84)(random); n > 0; --n) {
        const bool along_u = n % 2 == 0;
        const bool first = mostly(random) == (along_u ? toward_u : toward_v);
        auto halves = split(patch, along_u ? Parameter::u : Parameter::v, 0.5);
        patch = first ? std::move(halves.first) : std::move(halves.second);
    }
    return patch.position(0.5, 0.5);
}

// It found 9.5 mm where the surface was 0.1 mm away.
TEST(ClosestPoint, IsFoundWhereWeightsSpreadTheParametersUnevenly) {
    for (const auto& [points, seed] : {std::pair(4, 1U), std::pair(5, 2U), std::pair(8, 3U)}) {
        const BezierPatch patch = uneven(points, seed);
        const ClosestPointSearch search(patch);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> guess(0.0, 1.0);
        for (int n = 0; n < 200; ++n) {
            const Vec3 point = place_of(patch, random);
            EXPECT_LT(search.closest(point).distance, 1e-6) << points << " points, try " << n;
            EXPECT_LT(search.closest(point, {guess(random), guess(random)}).distance, 1e-6)
                << points << " points, guess " << n;
        }
    }
}

TEST(ClosestPoint, StaysInsideThePatchForPointsBeyondItsEdge) {
    const ClosestPointSearch search(dome());
    const ClosestPoint found = search.closest({-30.0, 46.25, 1.0});
    EXPECT_NEAR(found.parameters.x(), 0.0, 1e-14);
    EXPECT_NEAR(found.distance, 40.0, 1e-9);
}

} // namespace
} // namespace millwright::geometry
