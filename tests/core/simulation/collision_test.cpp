#include "core/simulation/collision.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/machine_solids.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace millwright::simulation {
namespace {

using program::BlockKind;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const kinematics::MachineModel& portal_router() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}
const kinematics::MachineModel& turning_table() {
    static const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    return machine;
}

toolpath::Profile flat(double diameter, double length) {
    return *toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = diameter, .length = length});
}
toolpath::Profile holder(double diameter, double length, double above) {
    return *toolpath::body_of(toolpath::HolderShape{diameter, length}, above);
}

CollisionTriangles box(const Vec3& low, const Vec3& high) {
    return surface_of(Stock(BoxStock{low, high}));
}

/// A block of 100 x 80 x 30 mm with a pocket of 60 x 40 x 20 mm, its floor's middle at the origin.
CollisionTriangles pocket() {
    const auto ring = [](double x, double y, double z) {
        return std::array<Vec3, 4>{Vec3(-x, -y, z), Vec3(x, -y, z), Vec3(x, y, z), Vec3(-x, y, z)};
    };
    CollisionTriangles surface;
    for (const auto& corners : {ring(50, 40, -10), ring(50, 40, 20), ring(30, 20, 20), ring(30, 20, 0)}) {
        surface.points.insert(surface.points.end(), corners.begin(), corners.end());
    }
    for (int row = 0; row < 3; ++row) {
        for (int n = 0; n < 4; ++n) {
            const int a = 4 * row + n, b = 4 * row + (n + 1) % 4;
            surface.triangles.push_back({a, b, b + 4});
            surface.triangles.push_back({a, b + 4, a + 4});
        }
    }
    surface.triangles.insert(surface.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}});
    return surface;
}

struct Checked {
    std::vector<CollisionTool> tools{};
    std::vector<CollisionBody> bodies{};
    double clearance = 0.0;
    double allowance = 0.01;
};

CollisionReport check(const kinematics::MachineModel& machine,
                      const WrittenProgram& writer,
                      Checked checked,
                      int first_block = 1) {
    return check_collisions({.program = writer.program(),
                             .machine = machine,
                             .tools = std::move(checked.tools),
                             .bodies = std::move(checked.bodies),
                             .first_block = first_block,
                             .clearance = checked.clearance,
                             .part_allowance = checked.allowance},
                            Progress());
}

CollisionBody part(const kinematics::MachineModel& machine, CollisionTriangles triangles) {
    return collision_body(machine, "part", BodyRole::part, std::move(triangles), true);
}
CollisionBody fixture(const kinematics::MachineModel& machine, CollisionTriangles triangles) {
    return collision_body(machine, "fixture", BodyRole::fixture, std::move(triangles), true);
}

WrittenProgram begun(double x, double y, double z) {
    WrittenProgram writer(portal_router());
    writer.go(BlockKind::rapid, {{'X', x}, {'Y', y}, {'Z', z}});
    return writer;
}

TEST(Collision, AFlatEndInTheWallOfAPocketIsAsDeepAsItOverlaps) {
    WrittenProgram writer = begun(0.0, 0.0, 30.0);
    writer.go(BlockKind::feed, {{'Z', 0.0}})
        .go(BlockKind::feed, {{'X', 30.0}}) // the wall is at 30: half of 16 mm
        .go(BlockKind::feed, {{'Y', 10.0}})
        .go(BlockKind::feed, {{'X', 0.0}});
    const CollisionReport found =
        check(portal_router(),
              writer,
              {.tools = {{.cutter = flat(16.0, 50.0)}}, .bodies = {part(portal_router(), pocket())}});
    ASSERT_THAT(found.collisions, SizeIs(1));
    const Collision& wall = found.collisions.front();
    EXPECT_EQ(wall.moving, "cutter");
    EXPECT_EQ(wall.still, "part");
    EXPECT_EQ(wall.line, 12);
    EXPECT_EQ(wall.last_line, 14);
    EXPECT_EQ(wall.moves, 3);
    EXPECT_NEAR(wall.depth, 8.0, 0.01);
    EXPECT_NEAR(wall.time * 30.0, 22.01, 0.01); // from where it is deeper than allowed
    EXPECT_NEAR(wall.place.x(), 30.0, 0.01);
    EXPECT_THAT(found.near_misses, IsEmpty());
}

TEST(Collision, ACutterThatTouchesThePartDoesNotCollide) {
    WrittenProgram writer = begun(0.0, 0.0, 30.0);
    writer.go(BlockKind::feed, {{'Z', 0.0}})
        .go(BlockKind::feed, {{'X', 22.0}})
        .go(BlockKind::feed, {{'Y', 12.0}});
    const CollisionReport found = check(portal_router(),
                                        writer,
                                        {.tools = {{.cutter = flat(16.0, 50.0)}},
                                         .bodies = {part(portal_router(), pocket())},
                                         .clearance = 1.0});
    EXPECT_THAT(found.collisions, IsEmpty());
    EXPECT_THAT(found.near_misses, IsEmpty()); // a cutter is always near what it cuts
}

TEST(Collision, AToolThatIsWhollyInThePartIsDeeperThanItsRadius) {
    WrittenProgram writer = begun(40.0, 0.0, 30.0);
    writer.go(BlockKind::rapid, {{'Z', 0.0}});
    const CollisionReport found =
        check(portal_router(),
              writer,
              {.tools = {{.cutter = flat(4.0, 50.0)}},
               .bodies = {part(portal_router(), box({0, -40, -30}, {80, 40, 20}))}});
    ASSERT_THAT(found.collisions, SizeIs(1));
    EXPECT_TRUE(found.collisions.front().rapid);
    EXPECT_NEAR(found.collisions.front().depth, 20.0, 0.01);
}

TEST(Collision, TheHolderMeetsTheRimOfAPocketThatIsTooDeepForTheTool) {
    WrittenProgram writer = begun(0.0, 0.0, 30.0);
    writer.go(BlockKind::feed, {{'Z', 4.0}}).go(BlockKind::feed, {{'X', 20.0}});
    const CollisionReport found =
        check(portal_router(),
              writer,
              {.tools = {{.cutter = flat(6.0, 15.0), .holder = holder(30.0, 40.0, 15.0)}},
               .bodies = {part(portal_router(), pocket())}});
    ASSERT_THAT(found.collisions, SizeIs(1)); // the holder's end is at 19 in a pocket whose rim is at 20
    EXPECT_EQ(found.collisions.front().moving, "holder");
    EXPECT_EQ(found.collisions.front().line, 12);
    EXPECT_NEAR(found.collisions.front().time * 20.0, 15.0, 0.01);
    EXPECT_NEAR(found.collisions.front().depth, 1.0, 0.01);
}

TEST(Collision, TheShankDoesNotCut) {
    WrittenProgram writer = begun(-20.0, 0.0, -5.0);
    writer.go(BlockKind::feed, {{'X', 0.0}});
    toolpath::ProfileShape above{.flat = 3.0, .radius = 3.0, .bottom = 10.0, .top = 40.0};
    const CollisionReport found =
        check(portal_router(),
              writer,
              {.tools = {{.cutter = flat(6.0, 10.0), .shank = toolpath::Profile(above)}},
               .bodies = {part(portal_router(), box({0, -5, 0}, {20, 5, 10}))}});
    ASSERT_THAT(found.collisions, SizeIs(2));
    EXPECT_EQ(found.collisions[1].moving, "shank");
    EXPECT_NEAR(found.collisions[1].depth, 3.0, 0.01);
}

TEST(Collision, AFixtureMayNotBeTouchedByTheCutter) {
    WrittenProgram writer = begun(-20.0, 0.0, 5.0);
    writer.go(BlockKind::rapid, {{'X', 20.0}});
    const auto clamp = fixture(portal_router(), box({-2, -2, 0}, {2, 2, 6}));
    const CollisionReport found =
        check(portal_router(), writer, {.tools = {{.cutter = flat(6.0, 30.0)}}, .bodies = {clamp}});
    ASSERT_THAT(found.collisions, SizeIs(1));
    EXPECT_EQ(found.collisions.front().still, "fixture");
    EXPECT_NEAR(found.collisions.front().time * 40.0, 15.0, 0.01);
    EXPECT_NEAR(found.collisions.front().place.z(), 5.5, 0.51);
}

TEST(Collision, NearMissesAreListedApart) {
    WrittenProgram writer = begun(-20.0, 0.0, 6.4);
    writer.go(BlockKind::rapid, {{'X', 20.0}});
    const auto clamp = fixture(portal_router(), box({-2, -2, 0}, {2, 2, 6}));
    const Checked checked{.tools = {{.cutter = flat(6.0, 30.0)}}, .bodies = {clamp}, .clearance = 0.5};
    const CollisionReport found = check(portal_router(), writer, checked);
    EXPECT_THAT(found.collisions, IsEmpty());
    ASSERT_THAT(found.near_misses, SizeIs(1));
    EXPECT_NEAR(found.near_misses.front().depth, 0.4, 0.001);
    Checked closer = checked;
    closer.clearance = 0.39;
    EXPECT_THAT(check(portal_router(), writer, closer).near_misses, IsEmpty());
}

TEST(Collision, TheTableTurnsAFixtureIntoTheHead) {
    WrittenProgram writer(turning_table());
    writer.go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 30.0}, {'A', 0.0}, {'C', 0.0}})
        .go(BlockKind::rapid, {{'A', -0.5 * pi}})
        .go(BlockKind::rapid, {{'A', 0.0}});
    std::vector<CollisionBody> bodies = machine_collision_bodies(turning_table(), {});
    const CollisionReport without =
        check(turning_table(), writer, {.tools = {{.cutter = flat(6.0, 40.0)}}, .bodies = bodies});
    EXPECT_THAT(without.collisions, IsEmpty());
    bodies.push_back(fixture(turning_table(), box({-10, 60, -50}, {10, 120, 80})));
    const CollisionReport found =
        check(turning_table(), writer, {.tools = {{.cutter = flat(6.0, 40.0)}}, .bodies = bodies});
    bool head = false;
    for (const Collision& collision : found.collisions) {
        EXPECT_EQ(collision.line, 11);
        EXPECT_EQ(collision.still, "fixture");
        head = head || collision.moving == "axis Z";
    }
    EXPECT_TRUE(head);
}

TEST(Collision, TheHeadMeetsTheTableThatIsDrawn) {
    WrittenProgram writer(turning_table());
    writer.go(BlockKind::rapid, {{'X', 110.0}, {'Y', 0.0}, {'Z', 30.0}, {'A', 0.0}, {'C', 0.0}})
        .go(BlockKind::rapid, {{'X', 130.0}, {'Z', -120.0}});
    const CollisionReport found = check(
        turning_table(),
        writer,
        {.tools = {{.cutter = flat(6.0, 40.0)}}, .bodies = machine_collision_bodies(turning_table(), {})});
    bool cutter = false, head = false;
    for (const Collision& collision : found.collisions) {
        cutter = cutter || collision.moving == "cutter";
        head = head || (collision.moving == "axis Z" && collision.still == "axis A");
        EXPECT_GT(collision.depth, 1.0) << collision.moving << collision.still;
    }
    EXPECT_TRUE(cutter);
    EXPECT_TRUE(head);
}

TEST(Collision, AxesBeyondTheirLimitsAreNamed) {
    WrittenProgram writer = begun(0.0, 0.0, 30.0);
    const double limit = portal_router().axis(portal_router().axis_index('X')).max;
    writer.go(BlockKind::rapid, {{'X', limit + 2.0}})
        .go(BlockKind::feed, {{'X', limit + 5.0}})
        .go(BlockKind::rapid, {{'X', limit}});
    const CollisionReport found = check(portal_router(), writer, {.tools = {{.cutter = flat(6.0, 40.0)}}});
    ASSERT_THAT(found.limits, SizeIs(1));
    EXPECT_EQ(found.limits.front().axis, 'X');
    EXPECT_EQ(found.limits.front().line, 11);
    EXPECT_EQ(found.limits.front().last_line, 12);
    EXPECT_DOUBLE_EQ(found.limits.front().position, limit + 5.0);
}

TEST(Collision, WhatIsNotCheckedIsNamed) {
    const WrittenProgram writer = begun(0.0, 0.0, 30.0);
    const CollisionReport bare = check(portal_router(), writer, {.tools = {{.cutter = flat(6.0, 40.0)}}}, 0);
    ASSERT_THAT(bare.unchecked, SizeIs(2));
    EXPECT_THAT(bare.unchecked[0], HasSubstr("the machine has no bodies"));
    EXPECT_THAT(bare.unchecked[1], HasSubstr("the tool has no holder"));
}

TEST(Collision, APartInTheFrameIsNotCheckedAgainstItAndNamed) {
    const WrittenProgram writer = begun(0.0, 0.0, 30.0);
    std::vector<CollisionBody> bodies{};
    bodies.push_back({"base",
                      BodyRole::machine,
                      '\0',
                      std::make_shared<const CollisionMesh>(box({-500, -500, -500}, {500, 500, 500})),
                      true});
    bodies.push_back(fixture(turning_table(), box({-5, -5, -5}, {5, 5, 5})));
    WrittenProgram still(turning_table());
    still.go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 300.0}, {'A', 0.0}, {'C', 0.0}});
    const CollisionReport found = check(turning_table(), still, {.tools = {{}}, .bodies = bodies}, 0);
    EXPECT_THAT(found.collisions, IsEmpty());
    ASSERT_THAT(found.unchecked, SizeIs(1));
    EXPECT_THAT(found.unchecked.front(), HasSubstr("drawn into each other"));
}

TEST(Collision, AFixtureInTheTableIsRefusedWithThePlace) {
    const std::vector<CollisionBody> bodies = machine_collision_bodies(turning_table(), {});
    // The table's top is 50 mm below the workpiece's origin.
    expect_on_table(fixture(turning_table(), box({20, 20, -50}, {40, 40, -20})), bodies, turning_table());
    try {
        expect_on_table(fixture(turning_table(), box({20, 20, -53}, {40, 40, -20})), bodies, turning_table());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("fixture lies 3.0"));
        EXPECT_THAT(error.diagnostic().message, HasSubstr("axis C"));
    }
}

TEST(Collision, TheShippedBodiesWithoutTheirCutterAreTheSameFromBothSources) {
    const auto solids = kinematics::read_machine_solids("assets/machines/ac-table.json", turning_table());
    ASSERT_NE(solids, nullptr);
    const auto drawn = machine_collision_bodies(turning_table(), *solids);
    const auto simple = machine_collision_bodies(turning_table(), {});
    ASSERT_EQ(drawn.size(), simple.size());
    for (std::size_t n = 0; n < drawn.size(); ++n) {
        EXPECT_EQ(drawn[n].name, simple[n].name);
        EXPECT_TRUE(drawn[n].closed);
        EXPECT_TRUE(drawn[n].mesh->box().isApprox(simple[n].mesh->box(), 1e-4)) << drawn[n].name;
        if (drawn[n].carrier == 'Z') {
            EXPECT_NEAR(drawn[n].mesh->box().min().z(), 45.0, 1e-3);
        }
    }
}

TEST(Collision, IsTheSameOnAnyNumberOfThreads) {
    WrittenProgram writer(turning_table());
    writer.go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 30.0}, {'A', 0.0}, {'C', 0.0}});
    for (int n = 0; n < 60; ++n) {
        writer.go(BlockKind::feed,
                  {{'A', from_degrees(n % 7 * 20.0)}, {'C', from_degrees(10.0 * n)}, {'Z', 40.0 - n}});
    }
    std::vector<CollisionBody> bodies = machine_collision_bodies(turning_table(), {});
    bodies.push_back(fixture(turning_table(), box({-10, 60, -50}, {10, 120, 80})));
    const Checked checked{.tools = {{.cutter = flat(6.0, 40.0), .holder = holder(30.0, 40.0, 40.0)}},
                          .bodies = bodies,
                          .clearance = 2.0};
    set_thread_count(1);
    const CollisionReport one = check(turning_table(), writer, checked);
    set_thread_count(3);
    const CollisionReport three = check(turning_table(), writer, checked);
    set_thread_count(0);
    ASSERT_EQ(one.collisions.size(), three.collisions.size());
    EXPECT_FALSE(one.collisions.empty());
    for (std::size_t n = 0; n < one.collisions.size(); ++n) {
        EXPECT_EQ(one.collisions[n].time, three.collisions[n].time);
        EXPECT_EQ(one.collisions[n].depth, three.collisions[n].depth);
        EXPECT_EQ(one.collisions[n].place, three.collisions[n].place);
    }
}

TEST(Collision, CanBeCancelled) {
    const WrittenProgram writer = begun(0.0, 0.0, 30.0);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)check_collisions({.program = writer.program(),
                                         .machine = portal_router(),
                                         .tools = {{.cutter = flat(6.0, 40.0)}},
                                         .bodies = {}},
                                        Progress({}, stop.get_token())),
                 Cancelled);
}

} // namespace
} // namespace millwright::simulation
