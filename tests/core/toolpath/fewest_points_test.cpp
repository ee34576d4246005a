#include "core/toolpath/fewest_points.h"

#include "core/toolpath/error_field.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

struct Found {
    Toolpath path;
    double farthest = 0.0; ///< from the surface, inside tracks
};

Found covered(const char* preset, double tolerance) {
    const auto patch = test::patch(preset);
    const auto machine = test::machine("ac-table");
    const Tool point;
    Found found{FewestPoints(tolerance).contacts(
        {patch, machine, point, Grid::uniform(5, 5), TrackDirection::along_u}, {})};
    const ErrorField field = error_field(patch, machine, found.path, sequence(machine, found.path), {60}, {});
    found.farthest = summary(field, Distance::closest, MoveKind::track).max;
    return found;
}

/// The error of the whole path, whose branches are chosen together, stays below the tolerance too.
TEST(FewestPoints, StayWithinTheToleranceOnTheWholePath) {
    std::size_t before = 0;
    for (const double tolerance : {0.5, 0.1, 0.02}) {
        const Found found = covered("saddle", tolerance);
        EXPECT_LE(found.farthest, tolerance * 1.001);
        EXPECT_GT(found.farthest, 0.3 * tolerance); // no more points than are needed
        EXPECT_GT(found.path.points.size(), before);
        before = found.path.points.size();
    }
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
    EXPECT_LE(path.points.size(), 4U * 4U); // the longest move that is looked at is less than a track
    EXPECT_EQ(path.points.front().origin.uv, Vec2(0.0, 0.0));
    EXPECT_EQ(path.points.back().origin.uv, Vec2(1.0, 0.0));
}

} // namespace
} // namespace millwright::toolpath
