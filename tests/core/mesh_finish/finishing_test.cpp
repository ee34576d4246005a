#include "core/mesh_finish/finishing.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/mesh_finish/mesh_inspection.h"
#include "core/toolpath/cutter.h"
#include "tests/core/mesh_finish/made_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stop_token>
#include <vector>

namespace millwright::mesh_finish {
namespace {

using toolpath::CutterKind;
using toolpath::CutterShape;

const CutterShape ball{.kind = CutterKind::ball, .diameter = 4.0};

FinishPath finished(const exchange::TriangleMesh& mesh,
                    const CutterShape& shape,
                    const FinishSettings& settings,
                    const Progress& progress = Progress()) {
    const DropTree tree = drop_tree(
        mesh, inspect(mesh, progress).open, pass_frame(settings.axis, settings.direction), progress);
    return finish(tree, CutterOutline(*toolpath::body_of(shape)), settings, progress);
}

exchange::TriangleMesh hills() {
    return test::graph_mesh({0, 30, 0, 20}, 60, 40, [](double x, double y) {
        return 3.0 * std::sin(0.4 * x) * std::cos(0.5 * y);
    });
}

/// A pocket with an upright wall along X and one along Y.
exchange::TriangleMesh corner_pocket() {
    exchange::TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}, {0, 0, 8}, {20, 0, 8}, {0, 20, 8}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}, {0, 3, 6}, {0, 6, 4}};
    return mesh;
}

/// What is left over a point of the surface along its normal by a ball on straight moves.
double left_over(const Vec3& point, const Vec3& normal, const FinishPath& path, double r) {
    double least = infinity;
    for (const FinishPass& pass : path.passes) {
        for (std::size_t n = 1; n < pass.tips.size(); ++n) {
            const Vec3 up = r * path.axis;
            const Vec3 a = pass.tips[n - 1] + up;
            const Vec3 span = pass.tips[n] + up - a;
            const double square_span = span.squaredNorm();
            const double t =
                square_span > 0.0 ? std::clamp((point - a).dot(span) / square_span, 0.0, 1.0) : 0.0;
            const Vec3 to = a + t * span - point;
            const double along = to.dot(normal);
            const double aside = to.squaredNorm() - along * along;
            if (aside < r * r) {
                least = std::min(least, along - std::sqrt(r * r - aside));
            }
        }
    }
    return least;
}

TEST(Finishing, LeavesNoMoreThanTheScallopOnASlopeOfAnySteepness) {
    constexpr double scallop = 0.02;
    for (const double steep_deg : {0.0, 35.0, 60.0, 80.0}) {
        for (const double around_deg : {0.0, 40.0, 90.0}) {
            const double rise = std::tan(from_degrees(steep_deg));
            const Vec2 uphill(std::cos(from_degrees(around_deg)), std::sin(from_degrees(around_deg)));
            const exchange::TriangleMesh slope = test::graph_mesh(
                {0, 6, 0, 6}, 1, 1, [&](double x, double y) { return rise * uphill.dot(Vec2(x, y)); });
            const FinishPath path =
                finished(slope, ball, {.step_over = step_for_scallop(2.0, scallop), .tolerance = 0.002});
            const Vec3 normal = Vec3(-rise * uphill.x(), -rise * uphill.y(), 1.0).normalized();
            double most = 0.0;
            for (int n = 0; n < 200; ++n) {
                const Vec2 at(2.5 + 0.005 * n, 2.5 + 0.0049 * (n * 7 % 200));
                const Vec3 point(at.x(), at.y(), rise * uphill.dot(at));
                const double left = left_over(point, normal, path, 2.0);
                EXPECT_GT(left, -0.002);
                most = std::max(most, left);
            }
            EXPECT_LE(most, scallop) << steep_deg << " " << around_deg;
            EXPECT_GT(most, 0.2 * scallop) << steep_deg << " " << around_deg;
        }
    }
}

TEST(Finishing, LeavesNoMoreThanTheScallopInAValleyBetweenPasses) {
    constexpr double scallop = 0.02;
    const double step = step_for_scallop(2.0, scallop);
    const auto most_left = [&](double bottom, bool between) {
        const exchange::TriangleMesh valley = test::graph_mesh(
            {0, 6, 0, 20.0 * step}, 1, 400, [&](double, double y) { return 0.9 * std::abs(y - bottom); });
        const FinishPath path =
            finished(valley, ball, {.step_over = step, .tolerance = 0.002, .between = between});
        const double angle = std::atan(0.9);
        double most = 0.0;
        for (const double side : {-1.0, 1.0}) { // beside where the ball touches both flanks
            const Vec3 normal(0.0, -side * std::sin(angle), std::cos(angle));
            for (int n = 1; n < 40; ++n) {
                const double y = bottom + side * (2.0 * std::sin(angle) + 0.02 * n);
                most = std::max(most, left_over({3.0, y, 0.9 * std::abs(y - bottom)}, normal, path, 2.0));
            }
        }
        return most;
    };
    double without = 0.0;
    for (const double place :
         {10.0, 10.15, 10.3, 10.45}) { // in steps, so that passes and their middles miss it
        EXPECT_LE(most_left(place * step, true), scallop) << place;
        without = std::max(without, most_left(place * step, false));
    }
    EXPECT_GT(without, 1.5 * scallop);
}

TEST(Finishing, CutsUprightWallsOfBothDirections) {
    const FinishPath path = finished(corner_pocket(), ball, {.step_over = 0.2, .tolerance = 0.004});
    for (const double z : {3.0, 4.5, 6.0}) {
        EXPECT_NEAR(left_over({10.03, 0.0, z}, Vec3::UnitY(), path, 2.0), 0.0, 0.01);
        EXPECT_NEAR(left_over({0.0, 10.03, z}, Vec3::UnitX(), path, 2.0), 0.0, 0.01);
    }
    const FinishPath one_way =
        finished(corner_pocket(), ball, {.step_over = 0.2, .tolerance = 0.004, .across = false});
    EXPECT_GT(left_over({10.03, 0.0, 4.5}, Vec3::UnitY(), one_way, 2.0), 0.01);
    EXPECT_LT(one_way.passes.size(), path.passes.size());
}

TEST(Finishing, LiftsLinksOverEverythingBetween) {
    const exchange::TriangleMesh mesh = hills();
    const FinishPath path = finished(mesh, ball, {.step_over = 1.0, .link_clearance = 1.5});
    const DropTree tree = drop_tree(mesh, {}, Mat3::Identity(), Progress());
    const CutterOutline cutter(*toolpath::body_of(ball));
    for (std::size_t n = 1; n < path.passes.size(); ++n) {
        const Vec3 from = path.passes[n - 1].tips.back();
        const Vec3 to = path.passes[n].tips.front();
        for (int k = 0; k <= 20; ++k) {
            const Vec3 at = from + 0.05 * k * (to - from);
            const auto rests = tree.drop(cutter, at.head<2>());
            EXPECT_TRUE(!rests || path.passes[n].link_level >= rests->z + 1.5 - 1e-9);
        }
        EXPECT_LE(path.passes[n].link_level, path.safe_level);
    }
}

TEST(Finishing, BeginsEachPassWhereTheOneBeforeEnded) {
    constexpr double step = 1.0;
    const exchange::TriangleMesh flat =
        test::graph_mesh({0, 30, 0, 20}, 10, 10, [](double, double) { return 0.0; });
    const FinishPath level = finished(flat, ball, {.step_over = step});
    ASSERT_GT(level.passes.size(), 15U);
    for (std::size_t n = 1; n < level.passes.size(); ++n) {
        const double away = (level.passes[n].tips.front() - level.passes[n - 1].tips.back()).norm();
        EXPECT_LT(away, 1.5 * step) << n;
    }
    const exchange::TriangleMesh valley =
        test::graph_mesh({0, 30, 0, 20}, 10, 400, [](double, double y) { return 0.9 * std::abs(y - 10.5); });
    const FinishPath between = finished(valley, ball, {.step_over = step, .across = false});
    ASSERT_GT(between.passes.size(), level.passes.size());
    for (std::size_t n = 1; n < between.passes.size(); ++n) {
        const Vec3& from = between.passes[n - 1].tips.back();
        const Vec3& to = between.passes[n].tips.front();
        if (to.y() > 1.0 && to.y() < 19.0) { // on the border passes begin anywhere
            EXPECT_LT((to - from).norm(), 3.0 * step) << n;
        }
    }
}

TEST(Finishing, LiftsLinksAboveTheAllowance) {
    const FinishPath bare = finished(hills(), ball, {.step_over = 1.0});
    const FinishPath path = finished(hills(), ball, {.step_over = 1.0, .allowance = 5.0});
    EXPECT_NEAR(path.safe_level, bare.safe_level + 5.0, 1e-9);
    ASSERT_EQ(path.passes.size(), bare.passes.size());
    for (std::size_t n = 1; n < path.passes.size(); ++n) {
        EXPECT_GE(path.passes[n].link_level, bare.passes[n].link_level + 5.0 - 1e-9);
        EXPECT_LE(path.passes[n].link_level, path.safe_level + 1e-9);
        EXPECT_GE(path.passes[n].plunge_level, path.passes[n].tips.front().z() + 7.0 - 1e-9);
    }
}

TEST(Finishing, PlungesBesideAWallFromAboveItsAllowance) {
    const FinishSettings settings{.direction = 0.5 * pi, .step_over = 0.5, .across = false, .allowance = 1.0};
    int beside = 0;
    int away = 0;
    for (const FinishPass& pass : finished(test::step_mesh(20.0, 12.0), ball, settings).passes) {
        const double x = pass.tips.front().x(); // of the wall, along which the passes go
        if (x > 2.2 && x < 2.8) {               // a ball on the floor, deep in the material on the wall
            EXPECT_NEAR(pass.plunge_level, std::sqrt(9.0 - x * x) - 2.0 + 2.0, 1e-6);
            ++beside;
        } else if (x > 3.2) {
            EXPECT_NEAR(pass.plunge_level, -12.0 + 1.0 + 2.0, 1e-6);
            ++away;
        }
    }
    EXPECT_GT(beside, 0);
    EXPECT_GT(away, 20);
}

/// Two low plates and a tower between them, beside the way from one to the other, in numbers of triangles
/// whose halves are no mixture of them.
exchange::TriangleMesh plates_and_tower() {
    exchange::TriangleMesh mesh;
    const auto add = [&](const std::array<double, 4>& area, int nx, double z) {
        const exchange::TriangleMesh level = test::graph_mesh(area, nx, 8, [&](double, double) { return z; });
        const int first = static_cast<int>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), level.points.begin(), level.points.end());
        for (const auto& [p, q, r] : level.triangles) {
            mesh.triangles.push_back({first + p, first + q, first + r});
        }
    };
    add({0, 10, 0, 6}, 8, -28.0);
    add({90, 100, 0, 6}, 16, -28.0);
    add({48, 52, 15, 17}, 8, 12.0);
    return mesh;
}

TEST(Finishing, LiftsLinksForTheHolder) {
    const FinishHolder holder{.radius = 20.0, .tool_length = 22.0};
    const FinishSettings bare{.step_over = 3.0, .across = false};
    FinishSettings settings = bare;
    settings.holder = holder;
    const DropTree tree = drop_tree(plates_and_tower(), {}, Mat3::Identity(), Progress());
    const FinishPath path = finished(plates_and_tower(), ball, settings);
    const CutterOutline body(toolpath::Profile({.flat = holder.radius, .radius = holder.radius}));
    for (std::size_t n = 1; n < path.passes.size(); ++n) {
        const Vec2 from = path.passes[n - 1].tips.back().head<2>();
        const Vec2 to = path.passes[n].tips.front().head<2>();
        for (int k = 0; k <= 50; ++k) {
            const auto rests = tree.drop(body, from + 0.02 * k * (to - from));
            EXPECT_TRUE(!rests || path.passes[n].link_level + holder.tool_length >= rests->z + 2.0 - 1e-9);
        }
    }
    const auto reach = holder_reach(tree, Mat3::Identity(), path, holder, Progress());
    EXPECT_TRUE(!reach || reach->length <= holder.tool_length);
    // Links that know nothing of it meet the tower with a holder.
    const auto met =
        holder_reach(tree, Mat3::Identity(), finished(plates_and_tower(), ball, bare), holder, Progress());
    ASSERT_TRUE(met);
    EXPECT_GT(met->length, 35.0);
    EXPECT_NEAR(met->tip.x(), 50.0, 21.0);
}

TEST(Finishing, IsTheSameForATurnedMeshAndAxis) {
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
    exchange::TriangleMesh turned = hills();
    for (Vec3& point : turned.points) {
        point = turn * point;
    }
    const FinishSettings settings{.step_over = 1.9, .tolerance = 0.01, .across = false};
    FinishSettings tilted = settings;
    tilted.axis = turn * Vec3::UnitZ();
    const Mat3 start = pass_frame(tilted.axis, 0.0);
    const Vec3 along = start * turn * Vec3::UnitX();
    tilted.direction = std::atan2(along.y(), along.x());
    const FinishPath straight = finished(hills(), ball, settings);
    const FinishPath path = finished(turned, ball, tilted);
    ASSERT_EQ(path.passes.size(), straight.passes.size());
    // Of a pass over the border rounding says where it touches the border alone, and ends.
    for (std::size_t n = 1; n + 1 < path.passes.size(); ++n) {
        EXPECT_NEAR((path.passes[n].tips.front() - turn * straight.passes[n].tips.front()).norm(), 0.0, 1e-6);
        EXPECT_NEAR(path.passes[n].link_level, straight.passes[n].link_level, 0.5); // by another tree
    }
}

TEST(Finishing, HasTheSameBytesOnAnyNumberOfThreads) {
    const auto tips_on = [](int threads) {
        set_thread_count(threads);
        std::vector<Vec3> tips;
        for (const FinishPass& pass : finished(hills(), ball, {.step_over = 0.7}).passes) {
            tips.insert(tips.end(), pass.tips.begin(), pass.tips.end());
        }
        set_thread_count(0);
        return tips;
    };
    const std::vector<Vec3> one = tips_on(1);
    EXPECT_GT(one.size(), 500U);
    EXPECT_TRUE(one == tips_on(3));
}

TEST(Finishing, SaysHowLongTheCutterMustBe) {
    const exchange::TriangleMesh step = test::step_mesh(20.0, 12.0);
    const FinishSettings settings{.step_over = 2.0, .across = false};
    const FinishPath path = finished(step, ball, settings);
    const DropTree tree = drop_tree(step, {}, pass_frame(settings.axis, 0.0), Progress());
    const auto reach = holder_reach(tree, pass_frame(settings.axis, 0.0), path, {6.0, 50.0}, Progress());
    ASSERT_TRUE(reach);
    EXPECT_NEAR(reach->length, 12.0, 1e-6); // the upper level, beside the wall
    EXPECT_GT(reach->tip.x(), 1.9);
    EXPECT_LT(reach->tip.x(), 6.0);
}

TEST(Finishing, RefusesSettingsOutOfRange) {
    EXPECT_THROW((void)finished(hills(), ball, {.step_over = 0.0}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.step_over = 1e-9}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.tolerance = 0.0}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.tolerance = 3.0}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.overrun = -1.0}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.link_clearance = 0.0}), Error);
    EXPECT_THROW((void)finished(hills(), ball, {.allowance = -1.0}), Error);
    const CutterShape needle{.kind = CutterKind::cone, .diameter = 3.0, .corner_radius = 0.0};
    EXPECT_THROW((void)finished(hills(), needle, {}), Error);
}

TEST(Finishing, EndsWhenCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)finished(hills(), ball, {}, Progress({}, stop.get_token())), Cancelled);
}

} // namespace
} // namespace millwright::mesh_finish
