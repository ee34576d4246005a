// Shank and holder in stock that the same move cuts away later. The judge is the same way in many short
// moves.
#include "core/kinematics/machine_file.h"
#include "core/simulation/simulation.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace millwright::simulation {
namespace {

using program::BlockKind;
using testing::IsEmpty;
using testing::SizeIs;

const kinematics::MachineModel& shank_router() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}

/// A cutter that ends at its flutes; above it a shank, or a holder, of the same diameter.
ToolUse with_flutes(toolpath::CutterKind kind, double flutes, bool holder = false) {
    constexpr double diameter = 10.0, length = 50.0;
    toolpath::ProfileShape cutting =
        toolpath::body_of({.kind = kind, .diameter = diameter, .length = length})->shape();
    const toolpath::Profile above(
        {.flat = cutting.radius, .radius = cutting.radius, .bottom = flutes, .top = length});
    cutting.top = flutes;
    ToolUse tool{0, 1, toolpath::Profile(cutting)};
    (holder ? tool.holder : tool.shank) = above;
    return tool;
}

/// Straight through `places`, each way in so many blocks.
std::vector<Finding>
findings_of(const std::vector<Vec3>& places, int blocks, const ToolUse& tool, double pitch) {
    WrittenProgram writer(shank_router());
    writer.add(BlockKind::spindle_on);
    const auto go = [&](BlockKind kind, const Vec3& to) {
        writer.go(kind, {{'X', to.x()}, {'Y', to.y()}, {'Z', to.z()}});
    };
    go(BlockKind::feed, places.front());
    for (std::size_t n = 1; n < places.size(); ++n) {
        for (int k = 1; k <= blocks; ++k) {
            const double share = static_cast<double>(k) / blocks;
            go(BlockKind::feed, places[n - 1] + share * (places[n] - places[n - 1]));
        }
    }
    return simulate({.program = writer.program(),
                     .machine = shank_router(),
                     .tools = {tool},
                     .stock = BoxStock{{0.0, 0.0, 0.0}, {60.0, 40.0, 7.0}},
                     .resolution = pitch},
                    Progress())
        .findings;
}

TEST(ShankInStock, IsFoundWhereTheSameMoveCutsThePlaceAwayLater) {
    const std::vector<Vec3> up{{-6.0, 20.0, 0.0}, {14.0, 20.0, 20.0}};
    for (const bool holder : {false, true}) {
        const ToolUse tool = with_flutes(toolpath::CutterKind::flat, 3.0, holder);
        const auto found = findings_of(up, 1, tool, 0.5);
        ASSERT_THAT(found, SizeIs(1));
        EXPECT_EQ(found.front().kind, holder ? FindingKind::holder_in_stock : FindingKind::shank_in_stock);
        EXPECT_EQ(found.front().line, 12);
        EXPECT_GT(found.front().depth, 0.5);
        EXPECT_LT(found.front().time, 0.25); // at tip 4 mm high the shank's end leaves the stock
        EXPECT_THAT(findings_of(up, 7, tool, 0.5), testing::Not(IsEmpty()));
    }
}

TEST(ShankInStock, DoesNotMeetWhatItsCutterHasClearedOnTheSameMove) {
    // Down to the floor at one place, with flutes that end where the flank does.
    for (const auto& [kind, flutes] : {std::pair(toolpath::CutterKind::flat, 3.0),
                                       std::pair(toolpath::CutterKind::flat, 0.5),
                                       std::pair(toolpath::CutterKind::ball, 5.0)}) {
        const ToolUse tool = with_flutes(kind, flutes);
        const std::vector<Vec3> down{{30.0, 20.0, 30.0}, {30.0, 20.0, -8.0}, {30.0, 20.0, 30.0}};
        EXPECT_THAT(findings_of(down, 1, tool, 0.5), IsEmpty()) << flutes;
    }
    // A slot that is shallower than the flutes, by a ramp.
    const ToolUse tool = with_flutes(toolpath::CutterKind::flat, 4.0);
    EXPECT_THAT(findings_of({{-10.0, 20.0, 8.0}, {70.0, 20.0, 3.1}}, 1, tool, 0.5), IsEmpty());
}

TEST(ShankInStock, IsTheSameInOneMoveAsInManyShortOnes) {
    std::mt19937 engine(3);
    const auto between = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
    };
    int met = 0, free = 0, graze = 0;
    constexpr int moves = 60;
    for (int n = 0; n < moves; ++n) {
        const bool ball = n % 3 == 0;
        const double flutes = between(ball ? 5.0 : 1.0, ball ? 9.0 : 6.0);
        const ToolUse tool =
            with_flutes(ball ? toolpath::CutterKind::ball : toolpath::CutterKind::flat, flutes, n % 2 == 0);
        const auto place = [&] {
            return Vec3(between(-15.0, 75.0), between(-15.0, 55.0), between(-2.0, 12.0));
        };
        const Vec3 from = place(), to = place();
        const int blocks = static_cast<int>(std::ceil((to - from).norm() / 0.2));
        const auto expected = findings_of({from, to}, blocks, tool, 0.8);
        const auto found = findings_of({from, to}, 1, tool, 0.8);
        double deepest = 0.0;
        for (const Finding& finding : expected) {
            deepest = std::max(deepest, finding.depth);
        }
        if (expected.empty()) {
            ++free;
            // Down a slope what is nearer than a tenth may count as met.
            EXPECT_TRUE(found.empty() || found.front().contact.length < 0.11)
                << n << ": " << found.front().contact.length;
            graze += found.empty() ? 0 : 1;
        } else if (deepest > 0.1) {
            ++met;
            EXPECT_THAT(found, SizeIs(1)) << n << ": " << deepest;
        }
    }
    EXPECT_GT(met, 15);
    EXPECT_GT(free, 10);
    EXPECT_LE(graze, 2);
}

} // namespace
} // namespace millwright::simulation
