#include "core/geometry/closest_point.h"

#include "core/geometry/presets.h"

#include <gtest/gtest.h>

#include <random>

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

TEST(ClosestPoint, StaysInsideThePatchForPointsBeyondItsEdge) {
    const ClosestPointSearch search(dome());
    const ClosestPoint found = search.closest({-30.0, 46.25, 1.0});
    EXPECT_NEAR(found.parameters.x(), 0.0, 1e-14);
    EXPECT_NEAR(found.distance, 40.0, 1e-9);
}

} // namespace
} // namespace millwright::geometry
