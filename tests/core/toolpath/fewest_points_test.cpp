#include "core/toolpath/fewest_points.h"

#include "core/toolpath/error_field.h"
#include "core/toolpath/tool_poses.h"
#include "tests/support/cutters.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

struct Found {
    Toolpath path;
    double farthest = 0.0; ///< from the surface, inside tracks
};

Found cover_with_fewest_points(const char* preset, double tolerance, const Tool& tool = {}) {
    const auto patch = test::patch(preset);
    const auto machine = test::machine("ac-table");
    Found found{with_tool(patch,
                          machine,
                          tool,
                          FewestPoints(tolerance).contacts(
                              {patch, machine, tool, Grid::uniform(5, 5), TrackDirection::along_u}, {}))};
    const ErrorField field = error_field(patch, machine, found.path, sequence(machine, found.path), {60}, {});
    found.farthest = summary(field, Distance::closest, MoveKind::track).max;
    return found;
}

/// The error of the whole path, whose branches are chosen together, stays below the tolerance too.
TEST(FewestPoints, StayWithinTheToleranceOnTheWholePath) {
    std::size_t before = 0;
    for (const double tolerance : {0.5, 0.1, 0.02}) {
        const Found found = cover_with_fewest_points("saddle", tolerance);
        EXPECT_LE(found.farthest, tolerance * 1.001);
        EXPECT_GT(found.farthest, 0.3 * tolerance); // no more points than are needed
        EXPECT_GT(found.path.points.size(), before);
        before = found.path.points.size();
    }
}

/// A tool that leans turns the machine another way.
TEST(FewestPoints, StayWithinTheToleranceOfTheToolAndItsLean) {
    const Lean leaning{.lead = from_degrees(8.0)};
    const std::array tools{Tool{.lean = leaning}, Tool{.cutter = test::body(test::ball), .lean = leaning}};
    for (const Tool& tool : tools) {
        for (const double tolerance : {0.5, 0.1}) {
            const Found found = cover_with_fewest_points("dome", tolerance, tool);
            EXPECT_LE(found.farthest, tolerance * 1.1) << "cutter " << tool.cutter.has_value();
            EXPECT_GT(found.farthest, 0.3 * tolerance);
        }
    }
}

/// A flat end bites into the hollows of the dome at the points themselves.
TEST(FewestPoints, OfACutterThatDoesNotFitAreThoseOfItsTip) {
    const Tool flat{.cutter = test::body(test::flat_end)};
    const Found found = cover_with_fewest_points("dome", 0.5, flat);
    EXPECT_GT(found.farthest, 0.5);
    EXPECT_LT(found.path.points.size(), 2 * cover_with_fewest_points("dome", 0.5).path.points.size());
}

TEST(FewestPoints, OfAPlaneAreTheEndsOfItsTracks) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {20.0 * i, 30.0 * j, 5.0 * i};
        }
    }
    const geometry::BezierPatch patch(net);
    const auto machine = test::machine("ac-table");
    const Tool point;
    const Toolpath path = FewestPoints(0.01).contacts(
        {patch, machine, point, Grid::uniform(4, 9), TrackDirection::along_v}, {});
    EXPECT_EQ(path.points.size(), 4U * 2U);
    EXPECT_EQ(path.points.front().origin.uv, Vec2(0.0, 0.0));
    EXPECT_EQ(path.points.back().origin.uv, Vec2(1.0, 0.0));
}

} // namespace
} // namespace millwright::toolpath
