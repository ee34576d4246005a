// Plans of a B-spline face of several spans. A patch that is written with inner knots is the same surface
// with the same parameters: its plan, made without any spans, is the judge.
#include "core/geometry/bspline_surface.h"
#include "core/plan/plan.h"
#include "core/plan/set_up_study.h"
#include "core/project/project_file.h"
#include "core/project/surface.h"
#include "tests/core/plan/sample_projects.h"
#include "tests/support/lens_face.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace millwright::plan {
namespace {

using geometry::BsplineNet;
using project::GridMethod;
using test::sample_folders;
using test::small_sample;

/// The same surface with one more knot in u, by Boehm's rule. For nets with weights 1.
BsplineNet with_knot(const BsplineNet& net, double knot) {
    const int p = net.degree_u;
    const auto above = std::upper_bound(net.knots_u.begin(), net.knots_u.end(), knot);
    const int k = static_cast<int>(above - net.knots_u.begin()) - 1;
    BsplineNet finer = net;
    finer.knots_u.insert(finer.knots_u.begin() + k + 1, knot);
    finer.rows = net.rows + 1;
    finer.points.clear();
    finer.weights.assign(static_cast<std::size_t>(finer.rows * finer.columns), 1.0);
    for (int i = 0; i < finer.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const auto t = [&](int n) { return net.knots_u[static_cast<std::size_t>(n)]; };
            const double share = i <= k - p ? 1.0 : i > k ? 0.0 : (knot - t(i)) / (t(i + p) - t(i));
            const Vec3 here = i < net.rows ? net.points[net.index(i, j)] : Vec3::Zero();
            const Vec3 before = i > 0 ? net.points[net.index(i - 1, j)] : Vec3::Zero();
            finer.points.push_back(share * here + (1.0 - share) * before);
        }
    }
    return finer;
}

/// Its patch as a face of 4 x 3 spans.
project::Project in_spans(project::Project project) {
    const geometry::ControlNet& patch = project.surface.patches.at(0);
    BsplineNet net;
    net.degree_u = patch.rows - 1;
    net.degree_v = patch.columns - 1;
    net.knots_u.assign(static_cast<std::size_t>(2 * patch.rows), 1.0);
    std::fill_n(net.knots_u.begin(), patch.rows, 0.0);
    net.knots_v.assign(static_cast<std::size_t>(2 * patch.columns), 1.0);
    std::fill_n(net.knots_v.begin(), patch.columns, 0.0);
    net.rows = patch.rows;
    net.columns = patch.columns;
    net.points = patch.points;
    net.weights = patch.weights;
    for (const double knot : {0.3, 0.31, 0.8}) {
        net = with_knot(net, knot);
    }
    net = geometry::turned_over(net);
    for (const double knot : {0.25, 0.6}) {
        net = with_knot(net, knot);
    }
    project.surface = {};
    project.surface.face = project::FaceInput{geometry::turned_over(net), {}};
    return project;
}

void expect_same_grid(GridMethod method, int nodes, double closeness) {
    project::Project project = small_sample("two-bell", nodes);
    project.grid.method = method;
    project.grid.chain.first_iterations = 20;
    project.grid.chain.later_iterations = 5;
    const Plan by_patch = make_plan(project, sample_folders, Progress());
    const project::Project spans = in_spans(project);
    ASSERT_EQ(geometry::BsplineSurface(spans.surface.face->net).spans(), std::pair(4, 3));
    const Plan by_spans = make_plan(spans, sample_folders, Progress());
    const Evaluation& a = *by_patch.program_path(project);
    const Evaluation& b = *by_spans.program_path(spans);
    EXPECT_NEAR(a.closest.max, b.closest.max, closeness * a.closest.max);
    EXPECT_NEAR(a.closest.mean, b.closest.mean, closeness * a.closest.mean);
    EXPECT_EQ(by_spans.singular_points.size(), by_patch.singular_points.size());
    EXPECT_FALSE(by_spans.listing->text.empty());
    EXPECT_NE(by_spans.trajectory, nullptr);
}

TEST(ExactFace, PlansAUniformGridAsThePatchThatItIs) {
    expect_same_grid(GridMethod::uniform, 10, 1e-9);
}

TEST(ExactFace, PlansOptimisedTracksAsThePatchThatItIs) {
    expect_same_grid(GridMethod::tracks, 8, 1e-6);
}

TEST(ExactFace, PlansTheWholeChainAsThePatchThatItIs) {
    expect_same_grid(GridMethod::chain, 6, 1e-4); // rounding grows on the way
}

TEST(ExactFace, PlansAnEllipticGridAsThePatchThatItIs) {
    expect_same_grid(GridMethod::elliptic, 8, 1e-6);
}

TEST(ExactFace, IsTurnedAndPlacedWithItsControlPoints) {
    const project::Project spans = in_spans(small_sample("dome", 6));
    const toolpath::SetUpPlace place(10.0, -5.0, 3.0, 0.5);
    const project::Project placed = with_set_up(spans, place);
    const Vec3 before = project::machined_region(spans.surface).position(0.3, 0.7);
    const Vec3 after = project::machined_region(placed.surface).position(0.3, 0.7);
    EXPECT_LT((after - Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * before).norm(), 1e-9);
    EXPECT_EQ(placed.machine.workpiece_offset, Vec3(10.0, -5.0, 3.0));
}

/// What is asked of it at its ends has no answer from the tangents.
TEST(ExactFace, IsPlannedThoughTwoOfItsSidesArePoints) {
    project::Project project = small_sample("dome", 7);
    project.surface = {};
    project.surface.face = project::FaceInput{test::lens_net(), {}};
    project.machine.file = "ac-table";
    project.grid.direction = grid::TrackDirection::along_u;
    for (const GridMethod method : {GridMethod::uniform, GridMethod::elliptic}) {
        project.grid.method = method;
        project.grid.elliptic.weight = project::WeightSource::expression;
        project.grid.elliptic.expression = "2 + nz";
        const Plan plan = make_plan(project, sample_folders, Progress());
        const Evaluation& path = *plan.program_path(project);
        EXPECT_GT(path.closest.max, 0.0);
        EXPECT_LT(path.closest.max, 1.0);
        EXPECT_EQ(std::ssize(path.toolpath.points), 49);
        EXPECT_FALSE(plan.listing->text.empty());
    }
}

TEST(ExactFace, IsCutInsideItsOutlineOnly) {
    project::Project project = in_spans(small_sample("dome", 9));
    project.grid.method = GridMethod::uniform;
    const Plan whole = make_plan(project, sample_folders, Progress());
    project.surface.face->trim.loops = {{{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.8}}};
    const Plan inside = make_plan(project, sample_folders, Progress());
    EXPECT_LT(inside.program_path(project)->path_length, 0.8 * whole.program_path(project)->path_length);
    for (const toolpath::PathPoint& point : inside.program_path(project)->toolpath.points) {
        const Vec2& uv = point.origin.uv;
        EXPECT_TRUE((uv.array() > 0.2 - 1e-9).all() && (uv.array() < 0.8 + 1e-9).all()) << uv.transpose();
    }
    EXPECT_EQ(inside.trims->size(), 1U);
}

} // namespace
} // namespace millwright::plan
