// Bodies of the machine against what is left of the stock, and against each other on one side of the machine.
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/machine_solids.h"
#include "core/simulation/collision.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::simulation {
namespace {

using program::BlockKind;
using testing::IsEmpty;
using testing::SizeIs;

const kinematics::MachineModel& router_of_bodies() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}

toolpath::Profile end_mill(double diameter, double length) {
    return *toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = diameter, .length = length});
}

/// At the physical zero, relative to the tip.
CollisionBody head_box(const char* name, char carrier, const Vec3& low, const Vec3& high) {
    const Vec3& tip = router_of_bodies().description().tool_tip;
    return {name,
            BodyRole::machine,
            carrier,
            std::make_shared<const CollisionMesh>(surface_of(Stock(BoxStock{tip + low, tip + high}))),
            true};
}

constexpr int first_of_thin_tool = 26; // block

/// A slot 20 mm wide and 25 mm deep from X 15 to X 45, by layers of 1 mm; then a thin tool in its middle, and
/// into its wall at Y 30.
WrittenProgram slot_and_thin_tool() {
    WrittenProgram writer(router_of_bodies());
    writer.go(BlockKind::rapid, {{'X', 15.0}, {'Y', 20.0}, {'Z', 1.0}});
    for (int layer = 1; layer <= 25; ++layer) {
        writer.go(BlockKind::feed, {{'X', layer % 2 == 1 ? 45.0 : 15.0}, {'Z', -static_cast<double>(layer)}});
    }
    return writer.go(BlockKind::rapid, {{'Z', 40.0}})
        .go(BlockKind::rapid, {{'X', 30.0}})
        .go(BlockKind::rapid, {{'Z', -22.0}})
        .go(BlockKind::feed, {{'Y', 27.0}});
}

struct RestOptions {
    Vec3 collar{4.0, 4.0, 10.0}; // half edges of the head's end, and its height above the tip
    bool rest = true;
    double resolution = 0.5; ///< mm
};

CollisionReport rest_report(const RestOptions& options) {
    const WrittenProgram writer = slot_and_thin_tool();
    const Stock stock(BoxStock{{0.0, 0.0, -30.0}, {60.0, 40.0, 0.0}});
    const SimulationInput removal{
        .program = writer.program(),
        .machine = router_of_bodies(),
        .tools = {{0, 1, end_mill(20.0, 60.0)}, {first_of_thin_tool, 2, end_mill(2.0, 10.0)}},
        .stock = stock,
        .resolution = options.resolution};
    const Vec3& collar = options.collar;
    return check_collisions(
        {.program = writer.program(),
         .machine = router_of_bodies(),
         .tools = {{.cutter = end_mill(20.0, 60.0)},
                   {.first_block = first_of_thin_tool, .cutter = end_mill(2.0, 10.0)}},
         .bodies =
             {head_box("collar", 'Z', {-collar.x(), -collar.y(), collar.z()}, {collar.x(), collar.y(), 60.0}),
              collision_body(router_of_bodies(), "stock", BodyRole::stock, surface_of(stock), true)},
         .first_block = 1,
         .removal = options.rest ? &removal : nullptr},
        Progress());
}

TEST(RemainingStock, TheHeadMeetsTheWallThatIsLeftAndNotWhatWasCut) {
    const CollisionReport found = rest_report({});
    ASSERT_THAT(found.collisions, SizeIs(1));
    const Collision& wall = found.collisions.front();
    EXPECT_EQ(wall.moving, "collar");
    EXPECT_EQ(wall.still, "stock");
    EXPECT_EQ(wall.line, 10 + 29);
    EXPECT_NEAR(wall.time * 7.0, 6.0, 0.02); // Y 26, and half of 8 mm
    EXPECT_NEAR(wall.place.y(), 30.0, 0.02);
    EXPECT_NEAR(wall.depth, 1.0, 0.02);
}

TEST(RemainingStock, WithoutRemovalTheUncutStockCounts) {
    const CollisionReport found = rest_report({.rest = false});
    ASSERT_FALSE(found.collisions.empty());
    EXPECT_LT(found.collisions.front().line, 10 + 29);
}

TEST(RemainingStock, TheHeadMeetsStockThatNoMoveHasCut) {
    // Wider than the slot: it meets the top of the stock on the layer that goes from 14 to 15 mm.
    const CollisionReport found = rest_report({.collar = {4.0, 15.0, 14.5}, .resolution = 1.0});
    ASSERT_FALSE(found.collisions.empty());
    EXPECT_EQ(found.collisions.front().line, 10 + 15);
    EXPECT_NEAR(found.collisions.front().time, 0.5, 0.01);
}

/// A slot 10 mm deep on each side of a rib that is 0.6 mm thin and begins at X `low`. The mesh of the surface
/// takes two cells of 0.5 mm together. The head goes down into one slot, along it, and through the rib.
CollisionReport thin_rib_report(double low) {
    constexpr double thickness = 0.6, radius = 5.0;
    WrittenProgram writer(router_of_bodies());
    writer.go(BlockKind::rapid, {{'X', low - radius}, {'Y', -10.0}, {'Z', -10.0}})
        .go(BlockKind::feed, {{'Y', 110.0}})
        .go(BlockKind::rapid, {{'X', low + thickness + radius}})
        .go(BlockKind::feed, {{'Y', -10.0}})
        .go(BlockKind::rapid, {{'Z', 40.0}});
    const int thin_tool = writer.program().block_count();
    writer.go(BlockKind::rapid, {{'X', low - radius}, {'Y', 50.0}})
        .go(BlockKind::rapid, {{'Z', -7.0}})
        .go(BlockKind::feed, {{'Y', 70.0}})
        .go(BlockKind::feed, {{'X', low + thickness + radius}});
    const Stock stock(BoxStock{{0.0, 0.0, -80.0}, {120.0, 100.0, 0.0}});
    const SimulationInput removal{
        .program = writer.program(),
        .machine = router_of_bodies(),
        .tools = {{0, 1, end_mill(2.0 * radius, 60.0)}, {thin_tool, 2, end_mill(2.0, 10.0)}},
        .stock = stock,
        .resolution = 0.5};
    return check_collisions(
        {.program = writer.program(),
         .machine = router_of_bodies(),
         .tools = {{.first_block = thin_tool, .cutter = end_mill(2.0, 10.0)}},
         .bodies = {head_box("collar", 'Z', {-2.0, -2.0, 2.0}, {2.0, 2.0, 60.0}),
                    collision_body(router_of_bodies(), "stock", BodyRole::stock, surface_of(stock), true)},
         .first_block = thin_tool,
         .removal = &removal},
        Progress());
}

TEST(RemainingStock, AThinRibIsMetWhereverItLiesBetweenTheLines) {
    for (const double beyond_line : {0.1, 0.35, 0.6}) {
        const double low = 60.0 + beyond_line;
        SCOPED_TRACE(low);
        const CollisionReport found = thin_rib_report(low);
        EXPECT_THAT(found.near_misses, IsEmpty());
        ASSERT_THAT(found.collisions, SizeIs(1));
        const Collision& rib = found.collisions.front();
        EXPECT_EQ(rib.moving, "collar");
        EXPECT_EQ(rib.still, "stock");
        EXPECT_EQ(rib.line, 10 + 8);
        EXPECT_NEAR(rib.time * 10.6, 3.0, 0.02); // its face is 5 mm from the start, and the head 2 mm wide
        EXPECT_NEAR(rib.place.x(), low, 0.02);
        EXPECT_GT(rib.depth, 0.1);
    }
}

TEST(BodiesOfOneSide, MeetWhereTheyCan) {
    WrittenProgram writer(router_of_bodies());
    writer.go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 50.0}})
        .go(BlockKind::rapid, {{'X', 100.0}})
        .go(BlockKind::rapid, {{'X', 0.0}});
    // Y carries X, which carries Z: the portal's upright is 80 mm beside the head.
    const std::vector<CollisionBody> bodies{head_box("upright", 'Y', {85, -10, -100}, {95, 10, 300}),
                                            head_box("slide", 'X', {-5, 20, 50}, {5, 30, 100}),
                                            head_box("head", 'Z', {-5, -5, 0}, {5, 5, 100})};
    const CollisionReport found = check_collisions({.program = writer.program(),
                                                    .machine = router_of_bodies(),
                                                    .tools = {{}},
                                                    .bodies = bodies,
                                                    .first_block = 1},
                                                   Progress());
    ASSERT_THAT(found.collisions, SizeIs(1));
    EXPECT_EQ(found.collisions.front().moving, "head");
    EXPECT_EQ(found.collisions.front().still, "upright");
    EXPECT_NEAR(found.collisions.front().time, 0.8, 1e-4);
}

/// Positions over all of the limits, or a turn.
WrittenProgram all_over(const kinematics::MachineModel& machine) {
    WrittenProgram writer(machine);
    constexpr int corners = 3; // each axis at its middle, low and high, the others at their middle
    const auto at = [&](int axis, int corner) {
        const kinematics::MachineAxis& one = machine.axis(axis);
        const bool bounded = one.max - one.min < 1e5;
        const double low = bounded ? one.min : -pi, high = bounded ? one.max : pi;
        return corner == 0 ? 0.5 * (low + high) : corner == 1 ? low : high;
    };
    for (int n = 0; n < machine.axis_count(); ++n) {
        for (int corner = 0; corner < corners; ++corner) {
            writer.go(BlockKind::rapid, {{machine.axis(n).letter, at(n, corner)}});
        }
        writer.go(BlockKind::rapid, {{machine.axis(n).letter, at(n, 0)}});
    }
    return writer;
}

TEST(BodiesOfOneSide, OfTheShippedMachinesStayApartWithinTheirLimits) {
    int looked_at = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/machines")) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        const kinematics::MachineModel machine = kinematics::read_machine(entry.path());
        const auto solids = kinematics::read_machine_solids(entry.path(), machine);
        const auto is_on_head = [&](const std::string& name) {
            for (const int axis : machine.head_chain()) {
                if (name == std::string("axis ") + machine.axis(axis).letter) {
                    return true;
                }
            }
            return false;
        };
        const WrittenProgram writer = all_over(machine);
        const CollisionReport found = check_collisions(
            {.program = writer.program(),
             .machine = machine,
             .tools = {{}},
             .bodies = machine_collision_bodies(
                 machine, solids ? std::span(*solids) : std::span<const geometry::SolidBody>())},
            Progress());
        for (const Collision& collision : found.collisions) {
            EXPECT_NE(is_on_head(collision.moving), is_on_head(collision.still))
                << entry.path() << ": " << collision.moving << " and " << collision.still << " line "
                << collision.line;
        }
        looked_at += found.pairs;
    }
    EXPECT_GT(looked_at, 8);
}

} // namespace
} // namespace millwright::simulation
