#include "core/exchange/grid_surface.h"

#include "core/exchange/cloud_fit.h"
#include "core/geometry/bspline_surface.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace millwright::exchange {
namespace {

using ::testing::HasSubstr;

template <class Height> PointGrid grid_of(int rows, int columns, const Height& height) {
    PointGrid grid{rows, columns, {}, {}};
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double x = -30.0 + 60.0 * i / (rows - 1), y = -30.0 + 60.0 * j / (columns - 1);
            grid.points.emplace_back(x, y, height(x, y));
            grid.lines.push_back(static_cast<int>(grid.points.size()));
        }
    }
    return grid;
}

double cap(double x, double y) {
    return std::sqrt(100.0 * 100.0 - x * x - y * y);
}

void expect_through(const GridSurface& made) {
    ASSERT_EQ(made.places.size(), made.grid.points.size());
    for (std::size_t n = 0; n < made.places.size(); ++n) {
        EXPECT_LT((made.face.position(made.places[n]) - made.grid.points[n]).norm(), 1e-9);
    }
}

/// Four by four points over 60 mm, up to 14 mm high: a bicubic patch, whose net stays with them.
TEST(GridSurface, GoesThroughFourByFourPointsWithAFairNet) {
    const double heights[4][4] = {{0, 6, 6, 0}, {6, 14, 14, 6}, {6, 14, 14, 6}, {0, 6, 6, 0}};
    const PointGrid grid = grid_of(4, 4, [&](double x, double y) {
        return heights[std::lround((x + 30.0) / 20.0)][std::lround((y + 30.0) / 20.0)];
    });
    const GridSurface made = surface_through(grid, {}, {});
    expect_through(made);
    ASSERT_EQ(made.face.patches.size(), 1U);
    EXPECT_EQ(made.face.patches[0].degree_u(), 3);
    EXPECT_EQ(made.face.patches[0].degree_v(), 3);
    const Box3& box = made.face.patches[0].control_box();
    EXPECT_GE(box.min().minCoeff(), -30.0 - 1e-9);
    EXPECT_LE(box.max().head<2>().maxCoeff(), 30.0 + 1e-9);
    EXPECT_LE(box.max().z(), 23.0); // the crown of the surface is above its highest points
    EXPECT_GT(made.face.patches[0].unit_normal(0.5, 0.5)->z(), 0.99);
}

TEST(GridSurface, GoesThroughRowsOfAnyLength) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    for (const auto& [rows, columns] : {std::pair(2, 2), {2, 9}, {6, 7}, {7, 6}, {5, 31}, {40, 23}}) {
        PointGrid grid =
            grid_of(rows, columns, [&](double x, double y) { return cap(x, y) + noise(random); });
        for (Vec3& point : grid.points) {
            point.head<2>() += 0.3 * Vec2(noise(random), noise(random)); // no row is straight or even
        }
        const GridSurface made = surface_through(grid, {}, {});
        expect_through(made);
        EXPECT_EQ(made.face.rows, rows <= most_points_of_one_span ? 1 : rows - 3);
        EXPECT_EQ(made.face.columns, columns <= most_points_of_one_span ? 1 : columns - 3);
    }
}

TEST(GridSurface, OfSeveralSpansIsOneSurfaceOfTheSamePatches) {
    const GridSurface made = surface_through(
        grid_of(8, 5, [](double x, double y) { return 5.0 * std::sin(0.1 * x) * std::cos(0.07 * y); }),
        {},
        {});
    ASSERT_TRUE(made.face.bspline);
    const geometry::BsplineSurface whole(*made.face.bspline);
    const std::vector<double> u = geometry::span_ends(made.face.bspline->knots_u);
    ASSERT_EQ(u.size(), 6U);
    for (int row = 0; row < made.face.rows; ++row) {
        const double begin = u[static_cast<std::size_t>(row)], end = u[static_cast<std::size_t>(row) + 1];
        for (const double share : {0.0, 0.3, 1.0}) {
            const Vec3 of_patch = made.face.patches[static_cast<std::size_t>(row)].position(share, 0.4);
            EXPECT_LT((whole.position(begin + share * (end - begin), 0.4) - of_patch).norm(), 1e-10) << row;
        }
    }
    EXPECT_FALSE(surface_through(grid_of(6, 2, [](double, double) { return 0.0; }), {}, {}).face.bspline);
}

/// Patches of a C2 spline meet with their first and second derivatives, each over its own length of
/// parameter.
TEST(GridSurface, IsSmoothFromPatchToPatch) {
    PointGrid grid =
        grid_of(9, 9, [](double x, double y) { return 5.0 * std::sin(0.1 * x) * std::cos(0.07 * y); });
    for (Vec3& point : grid.points) {
        point.x() += 0.002 * point.x() * point.x(); // spans of different lengths
    }
    const GridSurface made = surface_through(grid, {}, {});
    for (int row = 0; row + 1 < made.face.rows; ++row) {
        const auto& before = made.face.patches[static_cast<std::size_t>(row * made.face.columns)];
        const auto& after = made.face.patches[static_cast<std::size_t>((row + 1) * made.face.columns)];
        double ratio = 0.0;
        for (const double v : {0.0, 0.3, 1.0}) {
            const auto end = before.derivatives(1.0, v), begin = after.derivatives(0.0, v);
            EXPECT_LT((end.position - begin.position).norm(), 1e-10);
            const double here = end.du.norm() / begin.du.norm();
            ratio = ratio > 0.0 ? ratio : here; // the same all along the seam
            EXPECT_NEAR(here, ratio, 1e-9);
            EXPECT_LT((end.du - ratio * begin.du).norm(), 1e-9);
            EXPECT_LT((end.duu - ratio * ratio * begin.duu).norm(), 1e-8);
        }
    }
}

/// Through points of a bicubic polynomial surface that is measured at equal parameters the surface is that
/// one.
TEST(GridSurface, ComesBackToACylinderBetweenItsPoints) {
    PointGrid grid{24, 12, {}, {}};
    for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 12; ++j) {
            const double angle = -0.8 + 1.6 * i / 23.0;
            grid.points.emplace_back(80.0 * std::sin(angle), 5.0 * j, 80.0 * std::cos(angle));
            grid.lines.push_back(12 * i + j + 1);
        }
    }
    const GridSurface made = surface_through(grid, {}, {});
    double farthest = 0.0;
    for (const geometry::BezierPatch& patch : made.face.patches) {
        for (int k = 0; k <= 100; ++k) {
            const Vec3 at = patch.position(k / 100.0, 0.37);
            farthest = std::max(farthest, std::abs(std::hypot(at.x(), at.z()) - 80.0));
        }
    }
    EXPECT_LT(farthest, 2e-3); // the ends of an interpolating spline are free; 5e-5 of the radius elsewhere
}

TEST(GridSurface, LooksTheWayThatIsAskedFor) {
    const PointGrid grid = grid_of(4, 5, [](double, double) { return 0.0; });
    const auto up = [&](const std::optional<Vec3>& along) {
        return surface_through(grid, along, {}).face.patches[0].unit_normal(0.5, 0.5)->z();
    };
    EXPECT_NEAR(up({}), 1.0, 1e-12);
    EXPECT_NEAR(up(Vec3(0.0, 0.0, -1.0)), -1.0, 1e-12);
    const GridSurface down = surface_through(grid, Vec3(0.0, 0.0, -1.0), {});
    EXPECT_EQ(down.grid.lines.front(), 5); // each row is turned round, its lines with it
    expect_through(down);
}

TEST(GridSurface, RefusesPointsThatLieInOnePlace) {
    PointGrid grid = grid_of(3, 4, [](double, double) { return 0.0; });
    for (int i = 0; i < 3; ++i) {
        grid.points[static_cast<std::size_t>(4 * i + 2)] = grid.points[static_cast<std::size_t>(4 * i + 1)];
    }
    EXPECT_THAT(test::reason([&] { (void)surface_through(grid, {}, {}); }),
                HasSubstr("in every row, points 2 and 3 coincide"));
    const PointGrid long_one = grid_of(2, 1001, [](double, double) { return 0.0; });
    EXPECT_THAT(test::reason([&] { (void)surface_through(long_one, {}, {}); }), HasSubstr("1001 points"));
}

/// Scattered over the cap of a ball, no row anywhere.
std::vector<Vec3> scattered(std::size_t count, double noise) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-30.0, 30.0), error(-noise, noise);
    std::vector<Vec3> points{{-30, -30, 0}, {-30, 30, 0}, {30, -30, 0}, {30, 30, 0}};
    while (points.size() < count) {
        points.emplace_back(place(random), place(random), 0.0);
    }
    for (Vec3& point : points) {
        point.z() = cap(point.x(), point.y()) + (noise > 0.0 ? error(random) : 0.0);
    }
    return points;
}

TEST(CloudFit, FindsTheSurfaceThatPointsAreOf) {
    FitSettings settings;
    const MeshFit fit = fit_cloud(scattered(400, 0.0), settings, {});
    EXPECT_LT(fit.deviation.max, 0.02);
    EXPECT_EQ(fit.deviation.at_points.size(), 400U);
    EXPECT_TRUE(stays_near(fit.patch, fit.side.points, 0.1));
    double farthest = 0.0; // between the points too
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) {
            farthest = std::max(farthest, std::abs(fit.patch.position(i / 20.0, j / 20.0).norm() - 100.0));
        }
    }
    EXPECT_LT(farthest, 0.05);
    EXPECT_GT(fit.patch.unit_normal(0.5, 0.5)->z(), 0.99);
}

/// Nearly as many control points as points, and errors of measurement: the net must not follow them anywhere.
TEST(CloudFit, KeepsItsNetNearFewAndNoisyPoints) {
    for (const std::size_t count : {6U, 16U, 36U, 40U, 100U}) {
        for (const int degree : {cloud_degree(count), 5, 8}) {
            FitSettings settings;
            settings.degree_u = settings.degree_v = degree;
            const std::vector<Vec3> points = scattered(count, 0.5);
            const MeshFit fit = fit_cloud(points, settings, {});
            EXPECT_TRUE(stays_near(fit.patch, points, 0.1)) << count << " " << degree;
            EXPECT_LT(fit.deviation.max, 5.0) << count << " " << degree;
        }
    }
}

TEST(CloudFit, TakesADegreeThatThereArePointsFor) {
    EXPECT_EQ(cloud_degree(4), 1);
    EXPECT_EQ(cloud_degree(15), 2);
    EXPECT_EQ(cloud_degree(16), 3);
    EXPECT_EQ(cloud_degree(1000), 5);
}

TEST(CloudFit, RefusesWhatIsNoSurface) {
    const auto why = [](const std::vector<Vec3>& points) {
        return test::reason([&] { (void)fit_cloud(points, {}, {}); });
    };
    EXPECT_THAT(why({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("3 distinct points are too few"));
    EXPECT_THAT(why({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}), HasSubstr("lie on a line"));
}

} // namespace
} // namespace millwright::exchange
