#include "core/mesh_finish/pass_selection.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/toolpath/cutter.h"
#include "tests/core/mesh_finish/made_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace millwright::mesh_finish {
namespace {

TracedRun straight_run(int points) {
    TracedRun run;
    for (int n = 0; n < points; ++n) {
        run.push_back({1.0 * n, Drop{}});
    }
    return run;
}

std::vector<bool> needed_at(int points, const std::vector<std::size_t>& places) {
    std::vector<bool> needed(static_cast<std::size_t>(points), false);
    for (const std::size_t place : places) {
        needed[place] = true;
    }
    return needed;
}

TEST(PassSelection, CutsWhatIsNeededWithSomethingToSpare) {
    const auto parts = parts_of(straight_run(40), needed_at(40, {10, 30}), 2.0, 5.0);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].front().s, 8.0);
    EXPECT_EQ(parts[0].back().s, 12.0);
    EXPECT_EQ(parts[1].front().s, 28.0);
    EXPECT_EQ(parts[1].size(), 5U);
    EXPECT_TRUE(parts_of(straight_run(40), needed_at(40, {}), 2.0, 5.0).empty());
}

TEST(PassSelection, CutsThroughShortGaps) {
    const auto parts = parts_of(straight_run(40), needed_at(40, {10, 18}), 2.0, 5.0);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].size(), 13U);
    EXPECT_THROW((void)parts_of(straight_run(4), needed_at(5, {}), 1.0, 1.0), Defect);
}

TEST(PassSelection, AsksForPassesAcrossOnSteepPlaces) {
    TracedRun run = straight_run(5);
    run[1].drop.slope = {0.0, 0.9};
    run[2].drop.slope = {0.0, -1.1};
    run[3].drop.slope = {2.0, 2.1}; // 4.41 < 1 + 4
    run[4].drop.slope = {0.0, infinity};
    EXPECT_EQ(steep_across_x(run), (std::vector<bool>{false, false, true, false, true}));
    TracedRun wall = straight_run(3);
    wall[2].drop.z = 5.0;
    EXPECT_EQ(steep_across_x(wall), (std::vector<bool>{false, true, true}));
}

TEST(PassSelection, FindsADipBetweenPasses) {
    // A valley along X that ends at x = 5, where the ground is level.
    const exchange::TriangleMesh mesh = test::graph_mesh(
        {0, 10, -5, 5}, 100, 100, [](double x, double y) { return x < 5.0 ? std::abs(y) : 5.0; });
    const DropTree tree(mesh, {}, Progress());
    const CutterOutline cutter(
        *toolpath::body_of(toolpath::CutterShape{.kind = toolpath::CutterKind::ball, .diameter = 1.0}));
    const PassLine line{{0.5, 0.0}, Vec2::UnitX(), 9.0};
    const auto runs = traced(tree, cutter, line, 0.01);
    ASSERT_EQ(runs.size(), 1U);
    const std::vector<bool> dips = dips_between(tree, cutter, line, runs.front(), 0.2, 0.05);
    EXPECT_TRUE(dips.front());
    EXPECT_FALSE(dips.back());
    const std::vector<bool> border = dips_between(tree, cutter, line, runs.front(), 6.0, 0.05);
    EXPECT_TRUE(border.back()); // no mesh to both sides
}

} // namespace
} // namespace millwright::mesh_finish
