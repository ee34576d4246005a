#include "core/mesh_finish/drop_tree.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/toolpath/cutter.h"
#include "tests/core/mesh_finish/made_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::mesh_finish {
namespace {

using toolpath::CutterKind;
using toolpath::CutterShape;
using toolpath::Profile;

DropTree tree_of(const exchange::TriangleMesh& mesh) {
    return {mesh, {}, Progress()};
}

std::vector<CutterShape> all_kinds() {
    return {{.kind = CutterKind::ball, .diameter = 3.0},
            {.kind = CutterKind::flat, .diameter = 3.0},
            {.kind = CutterKind::bull_nose, .diameter = 4.0, .corner_radius = 0.7},
            {.kind = CutterKind::cone, .diameter = 6.0, .corner_radius = 0.5, .half_angle = 0.6},
            {.kind = CutterKind::cone, .diameter = 6.0, .corner_radius = 0.0, .half_angle = 0.3}};
}

/// Distance of a point from a triangle's plane and borders, by projection.
double distance_from(const exchange::TriangleMesh& mesh, int triangle, const Vec3& p) {
    const auto n = static_cast<std::size_t>(triangle);
    const Vec3 a = mesh.corner(n, 0);
    Eigen::Matrix<double, 3, 2> sides;
    sides << mesh.corner(n, 1) - a, mesh.corner(n, 2) - a;
    const Vec2 t = (sides.transpose() * sides).ldlt().solve(sides.transpose() * (p - a));
    const double outside = std::max({-t.x(), -t.y(), t.x() + t.y() - 1.0, 0.0});
    return (a + sides * t - p).norm() + outside * sides.norm();
}

/// The cutter touches the triangle that is named and has no dense point of the mesh inside: it can be neither
/// higher nor lower. The distance is that of the profile, which knows nothing of drops.
void expect_rests(const exchange::TriangleMesh& mesh,
                  const std::vector<Vec3>& points,
                  const Profile& body,
                  const Vec2& at,
                  const Drop& drop) {
    const geometry::ToolPose pose{Vec3(at.x(), at.y(), drop.z), Vec3::UnitZ()};
    EXPECT_NEAR(toolpath::distance(body, pose, drop.contact), 0.0, 1e-9);
    EXPECT_LT(distance_from(mesh, drop.triangle, drop.contact), 1e-9);
    for (const Vec3& point : points) {
        ASSERT_GT(toolpath::distance(body, pose, point), -1e-9)
            << "at " << at.transpose() << " of " << point.transpose();
    }
}

TEST(DropTree, RestsOnRandomTrianglesAndHasNothingInside) {
    const exchange::TriangleMesh mesh = test::random_triangles(60, 10.0, 7);
    const std::vector<Vec3> points = test::dense_points(mesh, 40);
    const DropTree tree = tree_of(mesh);
    int rests = 0;
    for (const CutterShape& shape : all_kinds()) {
        const Profile body = *toolpath::body_of(shape);
        const CutterOutline cutter(body);
        for (int n = 0; n < 60; ++n) {
            const Vec2 at(std::fmod(n * 1.37, 10.0), std::fmod(n * 2.91, 10.0));
            if (const auto drop = tree.drop(cutter, at)) {
                expect_rests(mesh, points, body, at, *drop);
                ++rests;
            }
        }
    }
    EXPECT_GT(rests, 250);
}

TEST(DropTree, MissesOnlyWhereNoPointIsUnderTheCutter) {
    const exchange::TriangleMesh mesh = test::random_triangles(3, 10.0, 3);
    const std::vector<Vec3> points = test::dense_points(mesh, 60);
    const DropTree tree = tree_of(mesh);
    const CutterOutline cutter(*toolpath::body_of(CutterShape{.kind = CutterKind::flat, .diameter = 1.0}));
    int missed = 0;
    for (int n = 0; n < 400; ++n) {
        const Vec2 at(n % 20 * 0.5, n / 20 * 0.5);
        const bool under = std::any_of(
            points.begin(), points.end(), [&](const Vec3& p) { return (p.head<2>() - at).norm() <= 0.5; });
        const bool found = tree.drop(cutter, at).has_value();
        EXPECT_TRUE(found || !under) << at.transpose();
        missed += found ? 0 : 1;
    }
    EXPECT_GT(missed, 50);
}

TEST(DropTree, StaysAtTheOffsetOfASphere) {
    constexpr double ball_r = 2.0;
    constexpr double dome_r = 10.0;
    const exchange::TriangleMesh dome =
        test::graph_mesh({-7.0, 7.0, -7.0, 7.0}, 280, 280, [](double x, double y) {
            return std::sqrt(dome_r * dome_r - x * x - y * y);
        });
    const DropTree tree = tree_of(dome);
    const CutterOutline cutter(*toolpath::body_of(CutterShape{.kind = CutterKind::ball, .diameter = 4.0}));
    // Chords of squares with sides of 0.05 mm, on slopes up to 45 degrees, are 0.05^2 / 4 / 10 below at most.
    for (double x = -5.0; x <= 5.0; x += 0.31) {
        const auto drop = tree.drop(cutter, {x, 0.4 * x});
        ASSERT_TRUE(drop);
        const double exact = std::sqrt(square(dome_r + ball_r) - 1.16 * x * x) - ball_r;
        EXPECT_LE(drop->z, exact + 1e-9);
        EXPECT_GT(drop->z, exact - 2e-4);
        EXPECT_NEAR(drop->slope.x(), -x / (exact + ball_r), 0.01);
    }
}

TEST(DropTree, FindsTheSameAsEveryTriangleAlone) {
    const exchange::TriangleMesh mesh = test::random_triangles(300, 30.0, 11);
    const DropTree tree = tree_of(mesh);
    const CutterOutline cutter(*toolpath::body_of(CutterShape{.kind = CutterKind::ball, .diameter = 5.0}));
    for (int n = 0; n < 200; ++n) {
        const Vec2 at(std::fmod(n * 3.7, 30.0), std::fmod(n * 7.1, 30.0));
        double best = -1e9;
        for (const auto& triangle : mesh.triangles) {
            exchange::TriangleMesh one{{mesh.points[static_cast<std::size_t>(triangle[0])],
                                        mesh.points[static_cast<std::size_t>(triangle[1])],
                                        mesh.points[static_cast<std::size_t>(triangle[2])]},
                                       {{0, 1, 2}}};
            if (const auto drop = tree_of(one).drop(cutter, at)) {
                best = std::max(best, drop->z);
            }
        }
        const auto drop = tree.drop(cutter, at);
        ASSERT_TRUE(drop);
        EXPECT_DOUBLE_EQ(drop->z, best);
    }
}

TEST(DropTree, KnowsTheBorder) {
    exchange::TriangleMesh mesh{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}};
    const DropTree tree(mesh, {0b111}, Progress());
    const CutterOutline cutter(*toolpath::body_of(CutterShape{.kind = CutterKind::ball, .diameter = 4.0}));
    EXPECT_FALSE(tree.drop(cutter, {3.0, 3.0})->on_open_edge);
    EXPECT_TRUE(tree.drop(cutter, {3.0, -1.0})->on_open_edge);
}

TEST(DropTree, NamesAHeightThatNothingNearExceeds) {
    const exchange::TriangleMesh mesh = test::random_triangles(100, 20.0, 5);
    const std::vector<Vec3> points = test::dense_points(mesh, 20);
    const DropTree tree = tree_of(mesh);
    const Vec2 from(2.0, 3.0);
    const Vec2 to(11.0, 9.0);
    const auto top = tree.highest_near(from, to, 1.5);
    ASSERT_TRUE(top);
    for (const Vec3& p : points) {
        const double t =
            std::clamp((p.head<2>() - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
        if ((p.head<2>() - from - t * (to - from)).norm() <= 1.5) {
            EXPECT_LE(p.z(), *top);
        }
    }
    EXPECT_FALSE(tree.highest_near({100.0, 100.0}, {110.0, 100.0}, 1.5));
}

TEST(DropTree, RefusesPointsThatAreNotFinite) {
    exchange::TriangleMesh mesh{{{0, 0, 0}, {10, 0, NAN}, {0, 10, 0}}, {{0, 1, 2}}};
    EXPECT_THROW((DropTree(mesh, {}, Progress())), Defect);
}

} // namespace
} // namespace millwright::mesh_finish
