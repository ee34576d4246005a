#include "core/plan/evaluation.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/presets.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/toolpath/shortest_sequence.h"
#include "tests/support/cutters.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>

namespace millwright::plan {
namespace {

CuttingSetup dome_on(const std::string& machine) {
    return {geometry::surface_preset("dome").make().patch(geometry::PatchId{0}), test::machine(machine)};
}

GridOutcome uniform(int nu, int nv) {
    return {grid::Grid::uniform(nu, nv)};
}

/// 5 x 5 nodes away from the dome's corners and top, where the normal is vertical and one angle is free.
grid::Grid off_the_poles() {
    grid::NodeArray nodes(5, 5);
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) {
            nodes.at(i, j) = {0.07 + 0.2 * i, 0.11 + 0.19 * j};
        }
    }
    return grid::Grid(nodes);
}

/// Of the consistent angles of `normal` the pair nearest to `near`.
kinematics::RotaryTiltAngles nearest_angles(const Vec3& normal, const kinematics::RotaryTiltAngles& near) {
    const auto first = kinematics::rotary_tilt_angles(kinematics::AngleMode::consistent, normal);
    kinematics::RotaryTiltAngles best;
    double least = 1e9;
    for (kinematics::RotaryTiltAngles way : {first, {first.A + pi, pi - first.B, false}}) {
        way.A += 2.0 * pi * std::round((near.A - way.A) / (2.0 * pi));
        const double travel = std::abs(way.A - near.A) + std::abs(way.B - near.B);
        if (travel < least) {
            least = travel;
            best = way;
        }
    }
    return best;
}

/// The largest parametric error inside the tracks along v, straight from the thesis's equations: axes linear
/// between the poses, mapped back, compared with the surface at the same fraction of the parameters.
double largest_param_error_by_hand(const grid::Grid& grid, int samples) {
    using namespace kinematics;
    const auto patch = geometry::surface_preset("dome").make().patch(geometry::PatchId{0});
    double largest = 0.0;
    RotaryTiltAngles before;
    Vec2 from;
    for (int n = 0; n < grid.nu() * grid.nv(); ++n) {
        const int i = n / grid.nv();
        const int step = n % grid.nv();
        const Vec2 to = grid.node(i, i % 2 == 0 ? step : grid.nv() - 1 - step);
        const RotaryTiltAngles now = nearest_angles(*patch.unit_normal(to.x(), to.y()), before);
        for (int k = 1; step > 0 && k <= samples; ++k) {
            const double t = static_cast<double>(k) / (samples + 1);
            const Vec3 M1 = machine_from_workpiece(
                listing_values, patch.position(from.x(), from.y()), before.A, before.B);
            const Vec3 M2 =
                machine_from_workpiece(listing_values, patch.position(to.x(), to.y()), now.A, now.B);
            const Vec3 W = workpiece_from_machine(listing_values,
                                                  M1 + t * (M2 - M1),
                                                  before.A + t * (now.A - before.A),
                                                  before.B + t * (now.B - before.B));
            const Vec2 uv = from + t * (to - from);
            largest = std::max(largest, (W - patch.position(uv.x(), uv.y())).norm());
        }
        before = now;
        from = to;
    }
    return largest;
}

TEST(Evaluation, AgreesWithTheThesissEquations) {
    const Evaluation found = evaluate(dome_on("rotary-tilt-listing"), {off_the_poles()}, {7}, Progress());
    EXPECT_GT(found.param.max, 1.0);
    EXPECT_NEAR(found.param.max, largest_param_error_by_hand(off_the_poles(), 7), 1e-9);
}

TEST(Evaluation, TheClosestPointIsNeverFartherThanTheParametricOne) {
    const Evaluation found = evaluate(dome_on("rotary-tilt-listing"), uniform(9, 7), {8}, Progress());
    ASSERT_EQ(found.field.moves.size(), 9u * 7u - 1u);
    for (const auto& move : found.field.moves) {
        EXPECT_LE(move.closest, move.param + 1e-9);
    }
    EXPECT_LT(found.closest.mean, found.param.mean);
    EXPECT_GT(found.cross_closest.max, 0.0);
}

TEST(Evaluation, TheGapOfAFlatSheetIsItsTrackSpacing) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(0, 0) = {-30, -20, 0};
    net.point(1, 0) = {30, -20, 0};
    net.point(0, 1) = {-30, 20, 0};
    net.point(1, 1) = {30, 20, 0};
    const CuttingSetup sheet{geometry::BezierPatch(net), test::machine("ac-table")};
    const Evaluation found = evaluate(sheet, uniform(7, 3), {4}, Progress());
    EXPECT_NEAR(found.track_gap.value(), 10.0, 1e-9);
    EXPECT_NEAR(found.path_length, 7 * 40.0 + 6 * 10.0, 1e-9);
    EXPECT_NEAR(found.closest.max, 0.0, 1e-9);
}

TEST(Evaluation, FaultyAnglesLeaveTheNormal) {
    CuttingSetup cutting_setup = dome_on("rotary-tilt-listing");
    EXPECT_LT(evaluate(cutting_setup, uniform(20, 20), {3}, Progress()).closest.axis_mean, from_degrees(2.0));
    cutting_setup.angle_mode = kinematics::AngleMode::faulty_text;
    EXPECT_GT(evaluate(cutting_setup, uniform(20, 20), {3}, Progress()).closest.axis_mean,
              from_degrees(10.0));
    cutting_setup.machine = test::machine("ac-table");
    EXPECT_THROW((void)evaluate(cutting_setup, uniform(20, 20), {3}, Progress()), Error);
}

TEST(Evaluation, OfAPathWhoseBranchesAreChosenForItAll) {
    using toolpath::MoveKind;
    using toolpath::SequencingGoal;
    CuttingSetup cutting_setup = dome_on("rotary-tilt-listing");
    const auto with = [&](const toolpath::SequencingSettings& settings) {
        cutting_setup.sequencing = settings;
        return evaluate(cutting_setup, uniform(12, 12), {8}, Progress());
    };
    const auto step = [&](const Evaluation& of) {
        return toolpath::largest_rotary_step(cutting_setup.machine, of.toolpath, of.axes, MoveKind::track);
    };
    const Evaluation nearest = evaluate(cutting_setup, uniform(12, 12), {8}, Progress());
    EXPECT_EQ(with({}).closest.mean, nearest.closest.mean);
    const Evaluation travel = with({.goal = SequencingGoal::travel});
    EXPECT_LE(travel.axes.rotary_travel, nearest.axes.rotary_travel * (1.0 + 1e-9));
    const Evaluation error = with({.goal = SequencingGoal::error});
    EXPECT_LT(error.closest.mean, nearest.closest.mean);
    const Evaluation finer = with({.goal = SequencingGoal::error, .largest_step = from_degrees(10.0)});
    EXPECT_GT(finer.toolpath.points.size(), error.toolpath.points.size());
    EXPECT_LT(finer.closest.max, 0.5 * error.closest.max);
    EXPECT_LT(step(finer), step(error));
}

/// A cutter cuts what its body says: on a router a ball's tip runs beside the surface, and touches it.
TEST(Evaluation, OfACutterIsOfItsBody) {
    CuttingSetup cutting_setup = dome_on("router-xyz");
    const auto touching = [&] { return evaluate(cutting_setup, uniform(20, 20), {8}, Progress()); };
    const Evaluation point = touching();
    cutting_setup.tool.cutter = test::body(test::ball);
    const Evaluation ball = touching();
    double farthest = 0.0;
    for (std::size_t n = 0; n < ball.toolpath.points.size(); ++n) {
        const toolpath::PathPoint& there = ball.toolpath.points[n];
        const Vec3 center = there.pose.tip + 4.0 * Vec3::UnitZ();
        EXPECT_NEAR((center - there.contact).norm(), 4.0, 1e-9);
        farthest = std::max(farthest, (there.pose.tip - point.toolpath.points[n].pose.tip).norm());
    }
    EXPECT_GT(farthest, 0.1);
    EXPECT_GT(ball.closest.max, point.closest.max); // its centre runs on a larger dome
}

TEST(Evaluation, APartOutOfReachIsAnError) {
    CuttingSetup cutting_setup = dome_on("ac-table");
    cutting_setup.machine = cutting_setup.machine.with_workpiece_offset({0, 0, 5000});
    EXPECT_THROW((void)evaluate(cutting_setup, uniform(4, 4), {3}, Progress()), Error);
}

TEST(Evaluation, StopsWhenCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)evaluate(
                     dome_on("ac-table"), uniform(4, 4), {3}, Progress([](const auto&) {}, stop.get_token())),
                 Cancelled);
}

} // namespace
} // namespace millwright::plan
