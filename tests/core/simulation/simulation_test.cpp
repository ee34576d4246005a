#include "core/simulation/simulation.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_file.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace millwright::simulation {
namespace {

using program::Block;
using program::BlockKind;
using testing::HasSubstr;
using testing::SizeIs;

const kinematics::MachineModel& router() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}
const kinematics::MachineModel& trunnion() {
    static const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    return machine;
}

toolpath::Profile flat(double diameter) {
    return *toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = diameter, .length = 40.0});
}

BoxStock plate() {
    return {{0.0, 0.0, -10.0}, {60.0, 40.0, 0.0}};
}

Simulation run(const WrittenProgram& writer,
               std::vector<ToolUse> tools,
               const Stock& stock = plate(),
               double pitch = 0.5) {
    return simulate({.program = writer.program(),
                     .machine = router(),
                     .tools = std::move(tools),
                     .stock = stock,
                     .resolution = pitch},
                    Progress());
}

WrittenProgram positioned() {
    WrittenProgram writer(router());
    writer.add(BlockKind::spindle_on)
        .go(BlockKind::rapid, {{'Z', 5.0}})
        .go(BlockKind::rapid, {{'X', 10.0}, {'Y', 20.0}});
    return writer;
}

TEST(Simulation, CutsWhatTheProgramCuts) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -3.0}})
        .go(BlockKind::feed, {{'X', 40.0}})
        .go(BlockKind::rapid, {{'Z', 5.0}});
    const Simulation found = run(writer, {{0, 1, flat(6.0)}}, plate(), 0.2);
    EXPECT_NEAR(found.removed_volume(), (30.0 * 6.0 + 9.0 * pi) * 3.0, 0.5);
    EXPECT_THAT(found.findings, SizeIs(0));
    EXPECT_EQ(found.cutting_moves, 2);
    ASSERT_TRUE(found.skipped.has_value());
    EXPECT_EQ(found.skipped->first_line, 11); // X and Y are not known before line 12
    EXPECT_EQ(found.skipped->last_line, 12);
    EXPECT_EQ(found.skipped->rapids, 2);
    EXPECT_EQ(found.skipped->feeds, 0);
    EXPECT_EQ(found.moves, 3);
}

TEST(Simulation, AHolderInWhatIsLeftIsFoundAndOneInWhatWasCutIsNot) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -3.0}})
        .go(BlockKind::feed, {{'X', 40.0}})  // the holder's end is 2 mm above the tip: 1 mm in the plate
        .go(BlockKind::feed, {{'X', 10.0}}); // the holder stays in the slot, which it does not widen
    const auto holder = [](double diameter) {
        return toolpath::Profile(
            {.flat = 0.5 * diameter, .radius = 0.5 * diameter, .bottom = 2.0, .top = 30.0});
    };
    ToolUse narrow{0, 1, flat(6.0)};
    narrow.holder = holder(5.0);
    const Simulation fits = run(writer, {narrow}, plate(), 0.2);
    EXPECT_THAT(fits.findings, SizeIs(0));
    ToolUse wide = narrow;
    wide.holder = holder(10.0);
    const Simulation found = run(writer, {wide}, plate(), 0.2);
    ASSERT_THAT(found.findings, SizeIs(3));
    for (const Finding& finding : found.findings) {
        EXPECT_EQ(finding.kind, FindingKind::holder_in_stock);
        EXPECT_GT(finding.depth, 0.2);
    }
    EXPECT_EQ(found.findings.front().line, 13);
    EXPECT_NEAR(found.findings.front().time, 0.93, 0.07); // the end meets the top when the tip is at -2
    EXPECT_NEAR(found.removed_volume(), fits.removed_volume(), 1e-3); // in other stretches
    EXPECT_EQ(found.cutting_moves, fits.cutting_moves);
    ToolUse shank{0, 1, flat(6.0)};
    shank.shank = holder(10.0);
    EXPECT_EQ(run(writer, {shank}, plate(), 0.2).findings.front().kind, FindingKind::shank_in_stock);
}

TEST(Simulation, AThinCutterLeavesNothingBehindOnItsWayDown) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -12.0}});
    toolpath::ProfileShape thin = flat(10.0).shape();
    thin.top = 0.5; // a fifth of the longest step
    const Simulation found = run(writer, {{0, 1, toolpath::Profile(thin)}});
    const Simulation expected = run(writer, {{0, 1, flat(10.0)}});
    EXPECT_NEAR(found.removed_volume(), expected.removed_volume(), 1e-6);
}

TEST(Simulation, NamesTheLineOfARapidThroughMaterial) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -3.0}})
        .go(BlockKind::rapid, {{'X', 40.0}})
        .go(BlockKind::rapid, {{'Z', 5.0}});
    const Simulation found = run(writer, {{0, 1, flat(6.0)}});
    ASSERT_THAT(found.findings, SizeIs(1));
    EXPECT_EQ(found.findings[0].kind, FindingKind::rapid_in_stock);
    EXPECT_EQ(found.findings[0].line, 14);
    EXPECT_NEAR(found.findings[0].volume, 30.0 * 6.0 * 3.0, 15.0);
    EXPECT_TRUE(Box3(plate().low, plate().high).contains(found.findings[0].contact.place));
}

TEST(Simulation, UsesTheToolThatWasChangedTo) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -3.0}}).go(BlockKind::rapid, {{'Z', 5.0}});
    const int change = writer.program().block_count();
    writer.go(BlockKind::rapid, {{'X', 40.0}}).go(BlockKind::feed, {{'Z', -3.0}});
    const Simulation found = run(writer, {{0, 1, flat(4.0)}, {change, 2, flat(10.0)}}, plate(), 0.2);
    EXPECT_NEAR(found.removed_volume(), (4.0 + 25.0) * pi * 3.0, 1.0);
}

TEST(Simulation, RefusesAFeedWithoutAToolAndNamesItsLine) {
    WrittenProgram writer = positioned();
    const int change = writer.program().block_count() + 1;
    writer.go(BlockKind::feed, {{'Z', -3.0}}).go(BlockKind::feed, {{'X', 30.0}});
    for (const std::vector<ToolUse>& tools : {std::vector<ToolUse>{},
                                              std::vector<ToolUse>{{change, 1, flat(6.0)}},
                                              std::vector<ToolUse>{{0, 0, std::nullopt}}}) {
        try {
            (void)run(writer, tools);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.diagnostic().place.line, 13);
            EXPECT_THAT(error.diagnostic().message, HasSubstr("no tool is in the spindle"));
        }
    }
}

TEST(Simulation, ReportsCutsWithoutSpindle) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'Z', -1.0}}).add(BlockKind::spindle_off).go(BlockKind::feed, {{'X', 20.0}});
    const Simulation found = run(writer, {{0, 1, flat(6.0)}});
    ASSERT_THAT(found.findings, SizeIs(1));
    EXPECT_EQ(found.findings[0].kind, FindingKind::spindle_off);
    EXPECT_EQ(found.findings[0].line, 15);
}

TEST(Simulation, FollowsMovesFromFarAwayAndRefusesEndlessOnes) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'X', -90'000.0}})
        .go(BlockKind::feed, {{'Z', -2.0}})
        .go(BlockKind::feed, {{'X', 90'000.0}});
    const Simulation found = run(writer, {{0, 1, flat(6.0)}});
    EXPECT_NEAR(found.removed_volume(), 60.0 * 6.0 * 2.0, 3.0);

    WrittenProgram turning(trunnion());
    turning.go(BlockKind::feed, {{'X', 1e9}, {'Y', 0.0}, {'Z', 1e9}, {'A', 0.0}, {'C', 0.0}})
        .go(BlockKind::feed, {{'C', 3.0}, {'A', 1.0}});
    try {
        (void)simulate({.program = turning.program(),
                        .machine = trunnion(),
                        .tools = {{0, 1, flat(6.0)}},
                        .stock = plate()},
                       Progress());
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.line, 11);
        EXPECT_THAT(error.diagnostic().message, HasSubstr("too far"));
    }
}

TEST(Simulation, RefusesAProgramOfAnotherMachine) {
    EXPECT_THROW((void)simulate({.program = positioned().program(),
                                 .machine = trunnion(),
                                 .tools = {{0, 1, flat(6.0)}},
                                 .stock = plate()},
                                Progress()),
                 Error);
}

// Both rotary axes and all linear ones move at once: the tool's way on the part is a curve, and the axis
// leaves the plane of its ends. Every end of the material lies on a pose that the machine takes.
TEST(Simulation, FollowsTheMachineBetweenBlocks) {
    const toolpath::Profile ball =
        *toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = 8.0, .length = 60.0});
    const kinematics::MachineModel& machine = trunnion();
    WrittenProgram writer(machine);
    writer.add(BlockKind::spindle_on)
        .go(BlockKind::rapid, {{'X', -15.0}, {'Y', -20.0}, {'Z', 30.0}, {'A', 0.1}, {'C', -0.4}})
        .go(BlockKind::feed, {{'X', 15.0}, {'Y', 10.0}, {'Z', 24.0}, {'A', 0.5}, {'C', 0.5}});
    const auto& program = writer.program();
    const kinematics::AxisPositions& from = program::position_before(program, 2);
    const kinematics::AxisPositions& to = program.blocks[2].target;
    Box3 box; // around the lower part of the way
    for (int n = 0; n <= 10; ++n) {
        box.extend(kinematics::forward(machine, from + n / 10.0 * (to - from)).tip);
    }
    const BoxStock stock{box.min() - Vec3(4.0, 4.0, 6.0), box.max() + Vec3(4.0, 4.0, 2.0)};
    const Simulation found = simulate(
        {.program = program, .machine = machine, .tools = {{0, 1, ball}}, .stock = stock, .resolution = 2.0},
        Progress());
    int ends = 0;
    double worst = 0.0;
    const DexelField& field = *found.field;
    const auto distance_at = [&](double f, const Vec3& place) {
        return toolpath::distance(ball, kinematics::forward(machine, from + f * (to - from)), place);
    };
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        for (int j = 0; j < field.count()[static_cast<std::size_t>(v)]; ++j) {
            for (int i = 0; i < field.count()[static_cast<std::size_t>(u)]; ++i) {
                for (const Dexel& piece : field.line(k, i, j)) {
                    for (const auto& [at, move] :
                         {std::pair(piece.from, piece.from_move), std::pair(piece.to, piece.to_move)}) {
                        if (move == stock_surface) {
                            continue;
                        }
                        Vec3 place;
                        place[u] = field.middle(u, i);
                        place[v] = field.middle(v, j);
                        place[k] = field.box().min()[k] + static_cast<double>(at);
                        double nearest = std::numeric_limits<double>::infinity();
                        int best = 0;
                        constexpr int instances = 1000;
                        for (int n = 0; n <= instances; ++n) {
                            const double distance = distance_at(1.0 * n / instances, place);
                            best = distance < nearest ? n : best;
                            nearest = std::min(nearest, distance);
                        }
                        double low = std::max(best - 1.0, 0.0) / instances;
                        double high = std::min(best + 1.0, 1.0 * instances) / instances;
                        for (int n = 0; n < 40; ++n) {
                            constexpr double golden = 0.6180339887498949;
                            const double a = high - golden * (high - low), b = low + golden * (high - low);
                            (distance_at(a, place) < distance_at(b, place) ? high : low) =
                                distance_at(a, place) < distance_at(b, place) ? b : a;
                        }
                        worst = std::max(worst, std::abs(std::min(nearest, distance_at(low, place))));
                        ++ends;
                    }
                }
            }
        }
    }
    EXPECT_GT(ends, 200);
    EXPECT_LT(worst, 2e-3);
}

TEST(Simulation, RemovesNothingFromARoundStockThatNoMoveMeets) {
    WrittenProgram writer = positioned();
    writer.go(BlockKind::feed, {{'X', 20.0}});
    const Stock cylinder = CylinderStock{Vec3(0.0, 0.0, -10.0), 2, 20.0, 0.0, 10.0};
    const Simulation untouched = run(writer, {{0, 1, flat(6.0)}}, cylinder, 1.0);
    EXPECT_DOUBLE_EQ(untouched.removed_volume(), 0.0);
    EXPECT_DOUBLE_EQ(untouched.left_volume, 1000.0 * pi);
    const Simulation gone = [&] {
        writer.go(BlockKind::feed, {{'X', 0.0}, {'Y', 0.0}}).go(BlockKind::feed, {{'Z', -11.0}});
        return run(writer, {{0, 1, flat(21.0)}}, cylinder, 1.0);
    }();
    EXPECT_DOUBLE_EQ(gone.left_volume, 0.0);
}

TEST(Simulation, NamesTheFeedsBeforeEveryAxisIsPositioned) {
    WrittenProgram writer(router());
    writer.add(BlockKind::spindle_on)
        .go(BlockKind::rapid, {{'Z', 5.0}})
        .go(BlockKind::feed, {{'X', 10.0}})
        .go(BlockKind::feed, {{'X', 12.0}})
        .go(BlockKind::rapid, {{'Y', 20.0}})
        .go(BlockKind::feed, {{'Z', -3.0}});
    const Simulation found = run(writer, {{0, 1, flat(6.0)}});
    ASSERT_TRUE(found.skipped.has_value());
    EXPECT_EQ(found.skipped->feeds, 2);
    EXPECT_EQ(found.skipped->first_feed_line, 12);
    EXPECT_EQ(found.skipped->last_feed_line, 13);
}

} // namespace
} // namespace millwright::simulation
