#include "core/mesh_finish/pass_tracing.h"

#include "core/base/numbers.h"
#include "core/mesh_finish/mesh_inspection.h"
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

const CutterShape ball_end{.kind = CutterKind::ball, .diameter = 4.0};
const CutterShape flat_end{.kind = CutterKind::flat, .diameter = 4.0};
const CutterShape bull_end{.kind = CutterKind::bull_nose, .diameter = 6.0, .corner_radius = 1.0};

DropTree tree_with_border(const exchange::TriangleMesh& mesh) {
    return {mesh, inspect(mesh, Progress()).open, Progress()};
}

TracedRun run_over(const exchange::TriangleMesh& mesh,
                   const CutterShape& shape,
                   const PassLine& line,
                   double tolerance) {
    const auto runs =
        traced(tree_with_border(mesh), CutterOutline(*toolpath::body_of(shape)), line, tolerance);
    EXPECT_EQ(runs.size(), 1U);
    return runs.empty() ? TracedRun{} : thinned(runs.front(), 0.5 * tolerance);
}

/// The deepest dense point of the mesh inside the cutter on the straight moves of a run.
double deepest_bite(const exchange::TriangleMesh& mesh,
                    const Profile& body,
                    const PassLine& line,
                    const TracedRun& run) {
    const std::vector<Vec3> points = test::dense_points(mesh, 12);
    double deepest = 0.0;
    for (std::size_t n = 1; n < run.size(); ++n) {
        constexpr int looks = 5;
        for (int k = 0; k <= looks; ++k) {
            const double t = static_cast<double>(k) / looks;
            const Vec2 at = line.from + mix(run[n - 1].s, run[n].s, t) * line.along;
            const Vec3 tip(at.x(), at.y(), mix(run[n - 1].drop.z, run[n].drop.z, t));
            for (const Vec3& p : points) {
                if ((p.head<2>() - at).norm() < body.shape().radius && p.z() > tip.z()) {
                    deepest = std::max(deepest, -toolpath::distance(body, {tip, Vec3::UnitZ()}, p));
                }
            }
        }
    }
    return deepest;
}

TEST(PassTracing, BitesNoDeeperThanItsTolerance) {
    const exchange::TriangleMesh rough = test::graph_mesh({0, 20, -6, 6}, 20, 12, [](double x, double y) {
        return 1.5 * std::sin(12.0 * x + 5.0 * y) + 0.7 * std::cos(31.0 * y);
    });
    const PassLine line{{1.0, 0.3}, Vec2::UnitX(), 18.0};
    for (const CutterShape& shape : {ball_end, flat_end, bull_end}) {
        for (const double tolerance : {0.1, 0.01}) {
            const TracedRun run = run_over(rough, shape, line, tolerance);
            EXPECT_LE(deepest_bite(rough, *toolpath::body_of(shape), line, run), tolerance);
            EXPECT_GT(run.size(), 10U);
        }
    }
}

TEST(PassTracing, CatchesTheBottomOfAValley) {
    const exchange::TriangleMesh valley =
        test::graph_mesh({-10, 10, -10, 10}, 2, 1, [](double x, double) { return std::abs(x); });
    // The bottom is at x = 0, where no look at equal steps from -7.77 falls.
    const TracedRun run = run_over(valley, ball_end, {{-7.77, 0.0}, Vec2::UnitX(), 15.0}, 0.01);
    const auto lowest = std::min_element(
        run.begin(), run.end(), [](const auto& a, const auto& b) { return a.drop.z < b.drop.z; });
    EXPECT_NEAR(lowest->drop.z, 2.0 * (std::sqrt(2.0) - 1.0), 0.01); // r (1 / sin 45 - 1)
    EXPECT_NEAR(lowest->s, 7.77, 0.01);
    EXPECT_LT(run.size(), 12U); // two straight flanks
}

TEST(PassTracing, StepsUpAWallWithAFlatEnd) {
    const exchange::TriangleMesh step = test::step_mesh(20.0, 5.0);
    const TracedRun run = run_over(step, flat_end, {{10.0, 0.0}, -Vec2::UnitX(), 20.0}, 0.01);
    EXPECT_NEAR(run.front().drop.z, -5.0, 1e-12);
    EXPECT_NEAR(run.back().drop.z, 0.0, 1e-12);
    // Down until the rim touches the wall, 2 mm before it, and up at once.
    const auto up = std::find_if(run.begin(), run.end(), [](const auto& p) { return p.drop.z > -4.0; });
    ASSERT_NE(up, run.end());
    EXPECT_NEAR(up->s, 8.0, 0.002);
    EXPECT_NEAR((up - 1)->s, 8.0, 0.002);
    EXPECT_GE(up->s - (up - 1)->s, 0.0);
}

TEST(PassTracing, EndsAtTheBorder) {
    const exchange::TriangleMesh sheet =
        test::graph_mesh({-5, 5, -5, 5}, 3, 3, [](double, double) { return 0.0; });
    const TracedRun run = run_over(sheet, ball_end, {{-9.0, 0.0}, Vec2::UnitX(), 18.0}, 0.01);
    EXPECT_NEAR(run.front().s, 4.0, 0.1);
    EXPECT_NEAR(run.back().s, 14.0, 0.1);
    EXPECT_NEAR(run.front().drop.z, 0.0, 0.01);
}

TEST(PassTracing, GivesOneRunForEachPartOfTheMesh) {
    exchange::TriangleMesh two = test::graph_mesh({0, 5, 0, 5}, 1, 1, [](double, double) { return 0.0; });
    const exchange::TriangleMesh other =
        test::graph_mesh({15, 20, 0, 5}, 1, 1, [](double, double) { return 3.0; });
    for (const Vec3& point : other.points) {
        two.points.push_back(point);
    }
    for (const auto& [a, b, c] : other.triangles) {
        two.triangles.push_back({a + 4, b + 4, c + 4});
    }
    const auto runs = traced(tree_with_border(two),
                             CutterOutline(*toolpath::body_of(ball_end)),
                             {{0.0, 2.5}, Vec2::UnitX(), 20.0},
                             0.01);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_NEAR(runs[0].back().s, 5.0, 0.1);
    EXPECT_NEAR(runs[1].front().s, 15.0, 0.1);
    EXPECT_TRUE(traced(tree_with_border(two),
                       CutterOutline(*toolpath::body_of(ball_end)),
                       {{0.0, 40.0}, Vec2::UnitX(), 20.0},
                       0.01)
                    .empty());
}

TEST(PassTracing, ThinsNoFurtherThanItsTolerance) {
    TracedRun run;
    for (int n = 0; n <= 200; ++n) {
        const double s = 0.1 * n;
        run.push_back({s, Drop{.z = std::sin(s)}});
    }
    const TracedRun thin = thinned(run, 0.01);
    EXPECT_LT(thin.size(), 100U);
    std::size_t k = 1;
    for (const TracedPoint& point : run) {
        while (thin[k].s < point.s) {
            ++k;
        }
        const Vec2 a(thin[k - 1].s, thin[k - 1].drop.z);
        const Vec2 b(thin[k].s, thin[k].drop.z);
        const double off = std::abs(cross(b - a, Vec2(point.s, point.drop.z) - a)) / (b - a).norm();
        EXPECT_LE(off, 0.01);
    }
}

} // namespace
} // namespace millwright::mesh_finish
