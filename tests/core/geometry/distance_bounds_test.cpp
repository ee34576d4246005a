#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/presets.h"
#include "core/geometry/surface_bounds.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::geometry {
namespace {

constexpr double bound_tolerance = 1e-3; // mm

/// Control points anywhere in a box: a surface that crosses itself many times.
BezierPatch wild_patch(int rows, int columns, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, 100.0), weight(0.5, 2.0);
    ControlNet net = ControlNet::sized(rows, columns);
    for (Vec3& point : net.points) {
        point = {coordinate(random), coordinate(random), coordinate(random)};
    }
    for (double& one : net.weights) {
        one = weight(random);
    }
    return BezierPatch(std::move(net));
}

Vec3 any_point(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-20.0, 120.0);
    const double x = coordinate(random), y = coordinate(random);
    return {x, y, coordinate(random)};
}

double raster_distance(const BezierPatch& patch, const Vec3& point) {
    constexpr int side = 300;
    double least = infinity;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const Vec3 there = patch.position(static_cast<double>(i) / side, static_cast<double>(j) / side);
            least = std::min(least, (there - point).norm());
        }
    }
    return least;
}

TEST(DistanceBounds, AreCloseWhereTheSearchIsRight) {
    const BezierPatch patch = surface_preset("dome").make().patch(PatchId{0});
    const ClosestPointSearch search(patch);
    std::mt19937 random(3);
    for (int n = 0; n < 50; ++n) {
        const Vec3 point = any_point(random);
        const double found = search.closest(point).distance;
        const DistanceBounds bounds = distance_bounds(patch, point, found, bound_tolerance);
        EXPECT_GE(bounds.at_least, found - 1.1 * bound_tolerance) << n;
        EXPECT_LE(bounds.at_least, found);
        EXPECT_EQ(bounds.at_most, found) << "nothing is nearer";
    }
}

TEST(DistanceBounds, HoldOnWildSurfaces) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const BezierPatch patch = wild_patch(8, 7, seed);
        std::mt19937 random(seed);
        for (int n = 0; n < 5; ++n) {
            const Vec3 point = any_point(random);
            const double nearest = raster_distance(patch, point);
            const DistanceBounds bounds = distance_bounds(patch, point, nearest + 15.0, bound_tolerance);
            EXPECT_LE(bounds.at_least, nearest + 1e-9) << "never above the truth, whatever was found";
            EXPECT_LE(bounds.at_most, nearest + bound_tolerance) << "what lies nearer is found";
            EXPECT_GE(bounds.at_least, bounds.at_most - 1.1 * bound_tolerance);
        }
    }
}

TEST(DistanceBounds, AreWideWhereTheWorkEnds) {
    const BezierPatch patch = wild_patch(8, 7, 1);
    const DistanceBounds bounds = distance_bounds(patch, {50.0, 50.0, 200.0}, 150.0, 1e-9, 3);
    EXPECT_GT(bounds.at_most - bounds.at_least, 1.0);
    EXPECT_LE(bounds.at_least, raster_distance(patch, {50.0, 50.0, 200.0}));
}

TEST(DistanceBounds, RefuseWhatIsNoDistance) {
    const test::WithoutTraps nan_is_handed_in;
    const BezierPatch patch = wild_patch(3, 3, 1);
    EXPECT_THROW((void)distance_bounds(patch, Vec3::Zero(), std::nan(""), 1.0), Defect);
    EXPECT_THROW((void)distance_bounds(patch, Vec3::Zero(), 1.0, 0.0), Defect);
}

} // namespace
} // namespace millwright::geometry
