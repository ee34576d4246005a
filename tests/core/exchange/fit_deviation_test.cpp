// How far a patch and what it was fitted to are apart, against shapes whose distance is known.
#include "core/exchange/internal/fit_deviation.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>

namespace millwright::exchange {
namespace {

using geometry::BezierPatch;
using geometry::ControlNet;

/// A flat square of side 10 at z = 0 as triangles of 1 mm.
FitTarget flat_square() {
    FitTarget target;
    TriangleMesh& mesh = target.side.mesh;
    constexpr int side = 10;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            mesh.points.emplace_back(i, j, 0.0);
        }
    }
    const auto at = [](int i, int j) { return i * (side + 1) + j; };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    target.side.area = side * side;
    return target;
}

/// A flat patch from the origin, `length` x 10 mm.
ControlNet flat_net(double length) {
    ControlNet net = ControlNet::sized(4, 2);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {length * i / 3.0, 10.0 * j, 0.0};
        }
    }
    return net;
}

Deviation measured(const ControlNet& net, bool follows_outline, const geometry::Trim& trim = {}) {
    const FitTarget square = flat_square();
    const FitComparison comparison(square, Vec3(Vec3::UnitZ()));
    return comparison.deviation_of(BezierPatch(net), trim, follows_outline, 1000, {});
}

// The mesh lies on the patch, and the patch goes on 5 mm beyond: the deviation was 0.
TEST(FitDeviation, IsMeasuredBothWays) {
    const Deviation deviation = measured(flat_net(15.0), false);
    EXPECT_LT(deviation.max, 1e-9);
    EXPECT_NEAR(deviation.patch_max, 5.0, 1e-9);
    EXPECT_NEAR(deviation.patch_mean, 5.0 / 6.0, 0.02); // a third of it is 2.5 mm away on average
    EXPECT_NEAR(deviation.patch_max_at.x(), 1.0, 1e-12);
    EXPECT_EQ(deviation.largest(), deviation.patch_max);
    EXPECT_LT(measured(flat_net(10.0), true).largest(), 1e-9);
}

/// However small it is: a raster over the whole patch would miss it.
TEST(FitDeviation, OfAPatchIsMeasuredInsideItsTrim) {
    geometry::Trim trim;
    trim.loops.push_back({{0.0, 0.0}, {0.8, 0.0}, {0.8, 1.0}, {0.0, 1.0}});
    EXPECT_NEAR(measured(flat_net(15.0), false, trim).patch_max, 2.0, 1e-9);
    trim.loops.front() = {{0.899, 0.501}, {0.9, 0.501}, {0.9, 0.502}};
    const Deviation deviation = measured(flat_net(15.0), false, trim);
    EXPECT_NEAR(deviation.patch_max, 3.5, 1e-9);
    EXPECT_NEAR(deviation.patch_mean, 3.49, 0.01);
}

TEST(FitDeviation, APatchThatLeavesTheOutlineItFollowsIsRefused) {
    EXPECT_THROW((void)measured(flat_net(15.0), true), Error);
    EXPECT_NO_THROW((void)measured(flat_net(10.1), true));
    EXPECT_THROW((void)measured(flat_net(20.0), false), Error); // half of the diagonal is 7.1 mm
}

TEST(FitDeviation, APatchThatFoldsIsRefused) {
    ControlNet net = flat_net(10.0);
    for (int j = 0; j < 2; ++j) {
        std::swap(net.point(1, j), net.point(2, j));
        net.point(1, j).x() += 10.0;
        net.point(2, j).x() -= 10.0;
    }
    try {
        (void)measured(net, false);
        ADD_FAILURE() << "it was taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("folds"), std::string::npos) << error.what();
    }
}

double distance_by_force(const TriangleMesh& mesh, const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps = 60;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        for (int a = 0; a <= steps; ++a) {
            for (int b = 0; a + b <= steps; ++b) {
                const double s = static_cast<double>(a) / steps, t = static_cast<double>(b) / steps;
                const Vec3 at =
                    (1.0 - s - t) * mesh.corner(n, 0) + s * mesh.corner(n, 1) + t * mesh.corner(n, 2);
                least = std::min(least, (at - point).norm());
            }
        }
    }
    return least;
}

TEST(TriangleSearch, FindsTheNearestPointOfRandomTriangles) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
    const auto anywhere = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    TriangleMesh mesh;
    for (int n = 0; n < 60; ++n) {
        const Vec3 at = anywhere();
        for (int k = 0; k < 3; ++k) {
            mesh.points.push_back(at + 0.3 * anywhere());
        }
        mesh.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    const TriangleSearch search(mesh);
    for (int n = 0; n < 40; ++n) {
        const Vec3 point = anywhere();
        const NearestTriangle found = search.nearest(point);
        const double by_force = distance_by_force(mesh, point);
        EXPECT_LE(found.distance, by_force + 1e-12);
        EXPECT_GT(found.distance, by_force - 0.15); // the raster is 0.1 mm wide
        Vec3 at = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(found.shares[k], 0.0);
            at += found.shares[k] * mesh.corner(found.triangle, k);
        }
        EXPECT_NEAR((at - point).norm(), found.distance, 1e-12);
    }
}

} // namespace
} // namespace millwright::exchange
