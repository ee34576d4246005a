#include "core/toolpath/constant_scallop.h"

#include "core/base/error.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/swept_cut.h"
#include "core/toolpath/tool_poses.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

geometry::BezierPatch plane(double width) {
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

/// Over a plane the step-over is sqrt(8 h R), the last one what is left.
TEST(ConstantScallop, OverAPlaneHasTracksOfEqualDistance) {
    const Toolpath path = tracks(plane(20.0), test::machine("router-xyz"), 0.05);
    const double gap = std::sqrt(8.0 * 0.05 * 4.0);
    const int count = static_cast<int>(std::ceil(20.0 / gap)) + 1;
    ASSERT_EQ(std::ssize(path.points), 12 * count);
    for (const PathPoint& point : path.points) {
        EXPECT_NEAR(point.contact.x(), std::min(point.origin.i * gap, 20.0), 1e-9);
    }
    EXPECT_EQ(path.points[12].reached_by, MoveKind::cross);
    EXPECT_EQ(path.points[11].contact.y(), path.points[12].contact.y()); // to and fro
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
    const auto patch = plane(20.0);
    const auto machine = test::machine("router-xyz");
    const Tool point;
    EXPECT_THROW((void)ConstantScallop(0.05).contacts({patch, machine, point, Grid::uniform(3, 3)}, {}),
                 Error);
    EXPECT_THROW((void)tracks(plane(2e4), machine, 1e-4), Error);
    EXPECT_THROW(ConstantScallop(0.0), Defect);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)ConstantScallop(0.05).contacts({patch, machine, ball, Grid::uniform(3, 3)},
                                                      {[](const auto&) {}, stop.get_token()}),
                 Cancelled);
}

} // namespace
} // namespace millwright::toolpath
