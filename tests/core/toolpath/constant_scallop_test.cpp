#include "core/toolpath/constant_scallop.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/swept_cut.h"
#include "core/toolpath/tool_poses.h"
#include "tests/support/ball_envelope.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <utility>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

geometry::BezierPatch plane_of_width(double width) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {width * i, 30.0 * j, 0.0};
        }
    }
    return geometry::BezierPatch(net);
}

const Tool ball{.cutter = test::body(test::ball)}; // 8 mm

Toolpath tracks(const geometry::BezierPatch& patch,
                const kinematics::MachineModel& machine,
                double height,
                TrackDirection direction = TrackDirection::along_v) {
    return ConstantScallop(height).contacts({patch, machine, ball, Grid::uniform(12, 12), direction}, {});
}

/// Over a plane two grooves that are g apart meet at R - sqrt(R^2 - g^2 / 4).
TEST(ConstantScallop, OverAPlaneHasTracksOfEqualDistanceThatLeaveTheHeight) {
    constexpr double wanted = 0.05;
    const Toolpath path = tracks(plane_of_width(20.0), test::machine("router-xyz"), wanted);
    const double gap = path.points[12].contact.x();
    const double left = 4.0 - std::sqrt(16.0 - 0.25 * gap * gap);
    EXPECT_LE(left, wanted);
    EXPECT_GT(left, 0.93 * wanted);
    const int count = static_cast<int>(std::ceil(20.0 / gap)) + 1;
    ASSERT_EQ(std::ssize(path.points), 12 * count);
    for (const PathPoint& point : path.points) {
        EXPECT_NEAR(point.contact.x(), std::min(point.origin.i * gap, 20.0), 1e-9);
    }
    EXPECT_EQ(path.points[12].reached_by, MoveKind::cross);
    EXPECT_EQ(path.points[11].contact.y(), path.points[12].contact.y()); // to and fro
}

/// A quarter of a cylinder of that radius, convex for the tool; u goes around, v along.
geometry::BezierPatch quarter_cylinder(double radius) {
    geometry::ControlNet net = geometry::ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {-radius, 30.0 * j, 0.0};
        net.point(1, j) = {-radius, 30.0 * j, radius};
        net.point(2, j) = {0.0, 30.0 * j, radius};
        net.weight(1, j) = std::sqrt(0.5);
    }
    return geometry::BezierPatch(net);
}

/// Around a cylinder of radius c two grooves that are an angle a apart meet at the distance
/// (c + R) cos(a/2) - sqrt(R^2 - (c + R)^2 sin^2(a/2)) from the axis.
TEST(ConstantScallop, AroundACylinderLeavesTheHeightOfTheClosedForm) {
    constexpr double wanted = 0.1;
    constexpr double c = 12.0;
    constexpr double R = 4.0;
    const Toolpath path = tracks(quarter_cylinder(c), test::machine("router-xyz"), wanted);
    const auto angle = [&](std::size_t track) {
        const Vec3& at = path.points[12 * track].contact;
        return std::atan2(at.z(), -at.x());
    };
    const std::size_t count = path.points.size() / 12;
    ASSERT_GT(count, 10U);
    for (std::size_t track = 1; track < count; ++track) {
        const double half = 0.5 * (angle(track) - angle(track - 1));
        const double side = (c + R) * std::sin(half);
        const double left = (c + R) * std::cos(half) - std::sqrt(R * R - side * side) - c;
        EXPECT_LE(left, 1.001 * wanted) << track;
        if (track + 1 < count) {
            EXPECT_GT(left, 0.92 * wanted) << track;
        }
    }
}

/// Where the front of the tracks has a fold, as behind the top of the dome, too.
TEST(ConstantScallop, LeavesNowhereMoreThanWasWanted) {
    const Tool small{.cutter = test::body({.kind = CutterKind::ball, .diameter = 6.0, .length = 30.0})};
    const auto machine = test::machine("router-xyz");
    for (const char* preset : {"dome", "sine", "two-bell", "saddle"}) {
        const auto patch = test::patch(preset);
        for (const auto& [wanted, nodes] : {std::pair(0.1, 120), {0.02, 20}}) {
            const Toolpath path =
                ConstantScallop(wanted).contacts({patch, machine, small, Grid::uniform(nodes, nodes)}, {});
            const test::BallEnvelope left(patch, 3.0, path, 0.1);
            const auto figures = left.figures(601, 41);
            EXPECT_LT(figures.max, 1.03 * wanted + 0.0005) << preset << " " << nodes; // spheres, no tube
            EXPECT_GT(figures.max, 0.95 * wanted) << preset << " " << nodes;
            EXPECT_GT(figures.mean, 0.27 * wanted) << preset << " " << nodes; // a third over a plane
        }
    }
}

TEST(ConstantScallop, HasTheSamePointsOnAnyNumberOfThreads) {
    const auto patch = test::patch("two-bell");
    const auto machine = test::machine("router-xyz");
    const auto contacts = [&](int threads) {
        set_thread_count(threads);
        return tracks(patch, machine, 0.2).points;
    };
    const auto one = contacts(1);
    const auto three = contacts(3);
    set_thread_count(0);
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t n = 0; n < one.size(); ++n) {
        EXPECT_EQ(one[n].contact, three[n].contact);
    }
}

/// What a sweep of the true cutter leaves, on a machine that makes no error of its own: never much more than
/// was wanted, and nearly that everywhere but beside the last track.
TEST(ConstantScallop, LeavesTheHeightThatWasWantedOnACurvedSurface) {
    constexpr double wanted = 0.1;
    for (const char* preset : {"dome", "saddle"}) {
        const auto patch = test::patch(preset);
        const auto machine = test::machine("router-xyz");
        const Toolpath path =
            with_tool(patch,
                      machine,
                      ball,
                      ConstantScallop(wanted).contacts(
                          {patch, machine, ball, Grid::uniform(60, 60), TrackDirection::along_v}, {}));
        const AxisPath axes = sequence(machine, path);
        std::vector<SweptMove> moves;
        for (std::size_t n = 1; n < path.points.size(); ++n) {
            moves.push_back(
                {axes.positions[n - 1], axes.positions[n], path.points[n].reached_by == MoveKind::track});
        }
        const SweptCut cut =
            swept_cut(patch, false, machine, ball, moves, {.nu = 201, .nv = 21, .step = 0.4});
        int high = 0;
        int rows = 0;
        for (int j = 4; j <= 16; ++j) { // away from the ends of the tracks
            double highest = 0.0;
            for (int i = 2; i < 199; ++i) {
                highest = std::max(highest, cut.height(i, j));
            }
            EXPECT_LT(highest, 1.3 * wanted) << preset << " row " << j;
            high += highest > 0.7 * wanted ? 1 : 0;
            ++rows;
        }
        EXPECT_EQ(high, rows) << preset;
    }
}

TEST(ConstantScallop, RefusesAPointAndTracksWithoutEnd) {
    const auto patch = plane_of_width(20.0);
    const auto machine = test::machine("router-xyz");
    const Tool point;
    EXPECT_THROW((void)ConstantScallop(0.05).contacts({patch, machine, point, Grid::uniform(3, 3)}, {}),
                 Error);
    EXPECT_THROW((void)tracks(plane_of_width(2e4), machine, 1e-4), Error);
    EXPECT_THROW(ConstantScallop(0.0), Defect);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)ConstantScallop(0.05).contacts({patch, machine, ball, Grid::uniform(3, 3)},
                                                      {[](const auto&) {}, stop.get_token()}),
                 Cancelled);
}

} // namespace
} // namespace millwright::toolpath
