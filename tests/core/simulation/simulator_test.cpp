#include "core/simulation/simulator.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"
#include "core/simulation/engagement.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

namespace millwright::simulation {
namespace {

using program::BlockKind;
using testing::HasSubstr;

const kinematics::MachineModel& mill() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}

/// Rounds in a plate, deeper and deeper.
WrittenProgram rounds(int count) {
    WrittenProgram writer(mill());
    writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', 10.0}, {'Y', 10.0}, {'Z', 5.0}});
    for (int n = 0; n < count; ++n) {
        const double angle = 0.17 * n;
        writer.go(
            BlockKind::feed,
            {{'X', 30.0 + 15.0 * std::cos(angle)}, {'Y', 20.0 + 10.0 * std::sin(angle)}, {'Z', -0.003 * n}});
    }
    return writer;
}

SimulationInput input_of(const WrittenProgram& writer, std::size_t most_bytes = 200'000'000) {
    return {
        .program = writer.program(),
        .machine = mill(),
        .tools = {{0,
                   1,
                   toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = 6.0, .length = 40.0})}},
        .stock = BoxStock{{0.0, 0.0, -10.0}, {60.0, 40.0, 0.0}},
        .resolution = 0.5,
        .most_bytes = most_bytes};
}

std::vector<Dexel> dexels_of(const DexelField& field) {
    std::vector<Dexel> all;
    for (int k = 0; k < 3; ++k) {
        for (const Tile& tile : field.tiles(k)) {
            all.insert(all.end(), tile.dexels.begin(), tile.dexels.end());
        }
    }
    return all;
}

std::vector<Dexel> cut_at_once(const SimulationInput& input, int block) {
    Simulator simulator(input, Rewind::none, Progress());
    simulator.advance_to(block, Progress());
    return dexels_of(simulator.field());
}

TEST(Simulator, IsTheSameBytesForwardsBackAndForwardsAgain) {
    const WrittenProgram writer = rounds(2500);
    const SimulationInput input = input_of(writer);
    Simulator simulator(input, Rewind::by_keyframes, Progress());
    for (const int block : {1200, 2502, 10, 1900, 0, 1899, 2502, 1, 1500}) {
        simulator.advance_to(block, Progress());
        EXPECT_EQ(simulator.block(), block);
        EXPECT_EQ(dexels_of(simulator.field()), cut_at_once(input, block)) << block;
    }
    simulator.advance_to(2502, Progress());
    EXPECT_GT(simulator.keyframe_count(), 2U);
    const Simulation expected = simulate(input, Progress());
    ASSERT_EQ(simulator.cuts().size(), expected.cuts.size());
    for (const auto& [move, cut] : expected.cuts) {
        EXPECT_NEAR(simulator.cuts().at(move).volume, cut.volume, 1e-9);
    }
    const Simulation found = std::move(simulator).finish();
    EXPECT_EQ(found.moves, expected.moves);
    EXPECT_EQ(found.cutting_moves, expected.cutting_moves);
    EXPECT_NEAR(found.left_volume, expected.left_volume, 1e-9);
}

TEST(Simulator, GoesToALineOfTheFile) {
    const WrittenProgram writer = rounds(50); // a line each from 10 on
    const SimulationInput input = input_of(writer);
    Simulator simulator(input, Rewind::by_keyframes, Progress());
    simulator.advance_to_line(30, Progress());
    EXPECT_EQ(simulator.block(), 21);
    simulator.advance_to_line(9, Progress());
    EXPECT_EQ(simulator.block(), 0);
    simulator.advance_to_line(10'000, Progress());
    EXPECT_EQ(simulator.block(), 52);
}

TEST(Simulator, KeepsKeyframesWithinItsMemory) {
    const WrittenProgram writer = rounds(8000);
    const SimulationInput roomy = input_of(writer);
    Simulator many(roomy, Rewind::by_keyframes, Progress());
    many.advance_to(8002, Progress());
    EXPECT_GT(many.keyframe_count(), 3U);
    const std::size_t tight_bytes = many.field().bytes() + many.keyframe_bytes() * 2 / 3;
    const SimulationInput tight = input_of(writer, tight_bytes);
    Simulator few(tight, Rewind::by_keyframes, Progress());
    few.advance_to(8002, Progress());
    EXPECT_LT(few.keyframe_count(), many.keyframe_count());
    EXPECT_LE(few.field().bytes() + few.keyframe_bytes(), tight_bytes);
    few.advance_to(5000, Progress());
    many.advance_to(5000, Progress());
    EXPECT_EQ(dexels_of(few.field()), dexels_of(many.field()));
}

TEST(Simulator, IsWholeAgainAfterItWasCancelled) {
    const WrittenProgram writer = rounds(600);
    const SimulationInput input = input_of(writer);
    Simulator simulator(input, Rewind::by_keyframes, Progress());
    simulator.advance_to(100, Progress());
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(simulator.advance_to(600, Progress({}, source.get_token())), Cancelled);
    simulator.advance_to(300, Progress());
    EXPECT_EQ(dexels_of(simulator.field()), cut_at_once(input, 300));
}

TEST(Simulator, RefusesToGoBackWithoutKeyframes) {
    const WrittenProgram writer = rounds(20);
    const SimulationInput input = input_of(writer);
    Simulator simulator(input, Rewind::none, Progress());
    simulator.advance_to(10, Progress());
    EXPECT_THROW(simulator.advance_to(5, Progress()), Defect);
}

TEST(Simulation, StopsWithALineWhereTheFieldOutgrowsItsMemory) {
    // Grooves across: lines along X have far more than two pieces each.
    WrittenProgram writer(mill());
    writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', 0.0}, {'Y', -5.0}, {'Z', -8.0}});
    for (double x = 0.6; x < 60.0; x += 1.2) {
        writer.go(BlockKind::rapid, {{'X', x}})
            .go(BlockKind::feed, {{'Y', 45.0}})
            .go(BlockKind::rapid, {{'Y', -5.0}});
    }
    SimulationInput input = input_of(writer);
    input.resolution = 0.3;
    input.tools.front().body =
        toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = 0.7, .length = 40.0});
    input.most_bytes = field_size(bounds(input.stock), input.resolution).bytes;
    try {
        (void)simulate(input, Progress());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("MB may be used"));
        EXPECT_THAT(error.diagnostic().hint, HasSubstr("resolution of"));
        EXPECT_GT(error.diagnostic().place.line, 10);
    }
}

TEST(Engagement, OfASlotIsItsSectionAndItsRate) {
    WrittenProgram writer(mill());
    writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', -10.0}, {'Y', 20.0}, {'Z', 5.0}});
    const auto feed = [&](std::initializer_list<std::pair<char, double>> to, double seconds) {
        writer.go(BlockKind::feed, to);
        program::Block block = writer.program().blocks.back();
        block.duration = seconds;
        writer.replace_last(block);
    };
    feed({{'Z', -2.0}}, 1.0);  // block 2: in air beside the plate
    feed({{'X', 70.0}}, 40.0); // block 3: the slot
    feed({{'X', -10.0}}, 9.0); // block 4: back through it
    feed({{'Y', 17.0}}, 1.0);
    feed({{'X', 70.0}}, 30.0); // block 6: half of a slot beside it, 3 mm wide
    SimulationInput input = input_of(writer);
    input.tools.front().body =
        toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = 6.0, .length = 40.0});
    input.resolution = 0.25;
    const Simulation found = simulate(input, Progress());
    const auto feeds = engagements(writer.program(), found);
    ASSERT_EQ(feeds.size(), 5U);
    EXPECT_EQ(feeds[1].block, 3);
    EXPECT_NEAR(feeds[1].removed, 60.0 * 6.0 * 2.0, 10.0);
    EXPECT_NEAR(feeds[1].rate(), 60.0 * feeds[1].removed / 40.0, 1e-9);
    EXPECT_NEAR(feeds[1].depth, 2.0, 0.01);
    EXPECT_NEAR(feeds[1].width, 6.0, 0.01);
    EXPECT_TRUE(feeds[2].in_air());
    EXPECT_NEAR(feeds[4].width, 3.0, 0.26);
    const EngagementSummary summary = summary_of(feeds);
    EXPECT_DOUBLE_EQ(summary.feed_time, 81.0);
    EXPECT_DOUBLE_EQ(summary.air_time, 11.0);
    EXPECT_EQ(summary.air_feeds, 3);
    ASSERT_TRUE(summary.fastest.has_value());
    EXPECT_EQ(summary.fastest->block, 3);
    EXPECT_THAT(csv_of(feeds), HasSubstr("\n13,3,40,"));
}

} // namespace
} // namespace millwright::simulation
