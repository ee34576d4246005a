#include "core/geometry/closest_point.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"
#include "tests/core/toolpath/leans.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;
using test::ten_degrees;

/// Of the path of `tool` over `contacts`.
ErrorField cutter_field(const geometry::BezierPatch& patch,
                        const kinematics::MachineModel& machine,
                        const Tool& tool,
                        const Toolpath& contacts) {
    const Toolpath path = with_tool(patch, machine, tool, contacts);
    return error_field(patch, machine, path, sequence(machine, path), {9}, {});
}

/// A router with a ball goes straight from tip to tip: on a cylinder of radius R it cuts a chord of the
/// circle R + r of its centre, whose sagitta is known.
TEST(CutterError, OfABallOverACylinderIsTheSagittaOfItsCentresWay) {
    constexpr double R = 30.0; // the quarter of a circle as a rational quadratic, symmetric to the vertical
    geometry::ControlNet net = geometry::ControlNet::sized(2, 3);
    const double s = std::sqrt(0.5);
    for (int i = 0; i < 2; ++i) {
        const double x = 40.0 * i;
        net.point(i, 0) = {x, -R * s, R * s};
        net.point(i, 1) = {x, 0.0, R / s};
        net.point(i, 2) = {x, R * s, R * s};
        net.weight(i, 1) = s;
    }
    const geometry::BezierPatch patch(net);
    const auto machine = test::machine("router-xyz");
    const Toolpath contacts = zigzag(patch, Grid::uniform(2, 9), TrackDirection::along_v, false);
    const ErrorField field = cutter_field(patch, machine, {.cutter = test::body(test::ball)}, contacts);
    for (std::size_t n = 0; n < field.moves.size(); ++n) {
        if (field.moves[n].kind == MoveKind::track) {
            const double angle = angle_between(contacts.points[n].normal, contacts.points[n + 1].normal);
            EXPECT_NEAR(field.moves[n].closest, (R + 4.0) * (1.0 - std::cos(0.5 * angle)), 1e-6);
        }
    }
}

/// Of a ball by the closest surface point of its centre, at every moment that is looked at. Where the centre
/// itself is in the part, the shank cuts too.
TEST(CutterError, OfABallIsThatOfItsCentre) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("ac-table");
    const geometry::ClosestPointSearch search(patch);
    const Toolpath contacts = zigzag(patch, Grid::uniform(8, 24), TrackDirection::along_v, false);
    for (const Lean& lean : {Lean{}, ten_degrees}) {
        const Tool tool{.cutter = test::body(test::ball), .lean = lean};
        const AxisPath axes = sequence(machine, with_tool(patch, machine, tool, contacts));
        const ErrorField field = cutter_field(patch, machine, tool, contacts);
        int compared = 0;
        for (std::size_t n = 0; n < field.moves.size(); ++n) {
            double most = 0.0;
            bool inside = true; // at the edge of the patch its normal does not point to the centre
            for (int k = 1; k <= 9; ++k) {
                const auto pose = actual_pose(machine, axes.positions[n], axes.positions[n + 1], 0.1 * k);
                const Vec3 center = pose.tip + 4.0 * pose.axis;
                const geometry::ClosestPoint foot = search.closest(center);
                most = std::max(most, std::abs(foot.distance - 4.0));
                const Vec2 from_middle = (foot.parameters - Vec2(0.5, 0.5)).cwiseAbs();
                inside = inside && from_middle.maxCoeff() < 0.499;
            }
            if (inside && field.moves[n].kind == MoveKind::track && most < 1.0) {
                EXPECT_NEAR(field.moves[n].closest, most, 1e-6) << n;
                ++compared;
            }
        }
        EXPECT_GT(compared, 80);
    }
}

/// A motion is a motion: where the tip is the contact the axis strays by as much, whatever the cutter.
TEST(CutterError, TheAxisIsThatOfThePointWhereTheTipTouches) {
    const auto patch = test::patch("two-bell");
    const auto machine = test::machine("ac-table");
    const Toolpath contacts = zigzag(patch, Grid::uniform(12, 12), TrackDirection::along_u, false);
    const auto axis_of = [&](const Tool& tool) {
        return summary(cutter_field(patch, machine, tool, contacts), Distance::closest, MoveKind::track)
            .axis_max;
    };
    const double of_a_point = axis_of({});
    EXPECT_GT(of_a_point, from_degrees(10.0));
    for (const CutterShape& shape : {test::ball, test::flat_end, test::bull_nose}) {
        EXPECT_NEAR(axis_of({.cutter = test::body(shape)}), of_a_point, 1e-9);
    }
}

/// The axis is compared with the one that was asked for, not with the normal.
TEST(CutterError, AToolThatLeansAsItShouldHasNoDeviationAtItsNodes) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("ac-table");
    const Tool tool{.cutter = test::body(test::bull_nose), .lean = ten_degrees};
    const auto axis_mean = [&](int nodes) {
        const Toolpath contacts = zigzag(patch, Grid::uniform(4, nodes), TrackDirection::along_v, false);
        return summary(cutter_field(patch, machine, tool, contacts), Distance::closest, MoveKind::track)
            .axis_mean;
    };
    EXPECT_LT(axis_mean(160), 0.25 * axis_mean(20));
    EXPECT_LT(axis_mean(160), from_degrees(1.0)); // of 10 asked for
}

/// However far a coarse move is off: a ball is no farther from the surface than its centre has come away from
/// where it should be.
TEST(CutterError, OfABallIsNoMoreThanItsCentreHasMoved) {
    const auto patch = test::patch("two-bell");
    const auto machine = test::machine("ac-table");
    const Tool tool{.cutter = test::body({.kind = CutterKind::ball, .diameter = 12.0, .length = 40.0})};
    int far = 0;
    for (const int n : {5, 6, 7}) {
        for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
            const Toolpath contacts = zigzag(patch, Grid::uniform(n, n), direction, false);
            const Toolpath path = with_tool(patch, machine, tool, contacts);
            const AxisPath axes = sequence(machine, path);
            for (const MoveDeviation& move : error_field(patch, machine, path, axes, {40}, {}).moves) {
                far += move.closest > 5.0 ? 1 : 0;
                EXPECT_LE(move.closest, move.param + 6.0 * move.axis);
            }
        }
    }
    EXPECT_GT(far, 0);
}

} // namespace
} // namespace millwright::toolpath
