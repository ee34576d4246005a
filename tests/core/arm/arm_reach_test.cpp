#include "core/arm/arm_forward.h"
#include "core/arm/arm_path.h"
#include "core/base/units.h"
#include "tests/support/arm_ways.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::arm {
namespace {

using ::testing::HasSubstr;

ArmReach reached(const ArmModel& arm, const std::vector<ArmWay>& ways, const ArmPathSettings& settings = {}) {
    return reach_of(follow_path_well(arm, ways, arm.home(), settings, {}), ways);
}

TEST(ArmReach, NamesEachPointBeyondTheReachAndHowFarItIsOff) {
    const ArmModel l3 = test::arm("motoman-l3");
    constexpr double longest = 1450.0; // upper arm and forearm in one line
    const Vec3 down = -Vec3::UnitZ();
    ArmWay out = test::line_way(Vec3(1000.0, 0.0, 0.0), Vec3(1900.0, 0.0, 0.0), down);
    ArmWay back = test::line_way(Vec3(1900.0, 0.0, 0.0), Vec3(1900.0, 900.0, 0.0), down);
    out.line = 3;
    back.line = 4;
    const std::vector<ArmWay> ways{out, back};
    const ArmPath path = follow_path_well(l3, ways, l3.home(), {}, {});
    const ArmReach found = reach_of(path, ways);
    ASSERT_EQ(found.holes.size(), 1U);
    const ArmHole& hole = found.holes.front();
    EXPECT_EQ(hole.trouble, ArmTrouble::out_of_reach);
    EXPECT_EQ(hole.first().line, 3);
    EXPECT_EQ(hole.last().line, 4);
    EXPECT_NEAR(hole.first().tip.x(), longest, 0.5);
    EXPECT_NEAR(hole.first().along, longest - 1000.0, 0.5);
    EXPECT_EQ(hole.last().point, path.points.size());
    EXPECT_NEAR(hole.last().along, 1800.0, 1e-9);
    EXPECT_EQ(hole.points.size(), hole.last().point - hole.first().point + 1);
    for (const ArmReachPoint& at : hole.points) {
        EXPECT_NEAR(at.off.tip, at.tip.norm() - longest, 1e-6);
        EXPECT_EQ(at.off.joint.joint, -1);
    }
    EXPECT_EQ(hole.worst().point, hole.last().point);
    EXPECT_EQ(to_text(l3, hole.trouble, hole.worst().off), "652.380 mm off");
}

TEST(ArmReach, NamesTheJointAndHowFarItIsBeyondItsLimit) {
    ArmDescription narrow = test::arm("motoman-l3").description();
    for (const int joint : {0, 1}) {
        narrow.joints[static_cast<std::size_t>(joint)].min = from_degrees(-90.0);
        narrow.joints[static_cast<std::size_t>(joint)].max = from_degrees(90.0);
    }
    const ArmModel arm(narrow);
    // Over its back joint 2 would have to lean beyond -90 degrees.
    const ArmReach found = reached(arm, {test::around_the_base(1300.0, 0.0, 0.0, from_degrees(120.0))});
    ASSERT_FALSE(found.holes.empty());
    const ArmHole& hole = found.holes.front();
    EXPECT_EQ(hole.trouble, ArmTrouble::joint_limit);
    EXPECT_EQ(hole.worst().off.joint.joint, 0);
    EXPECT_NEAR(to_degrees(hole.worst().off.joint.beyond), 30.0, 1e-6);
    EXPECT_EQ(to_text(arm, hole.trouble, hole.worst().off), "joint 1 is 30.000 deg beyond its limit");
}

TEST(ArmReach, TellsHowFarAJumpIs) {
    const ArmModel l3 = test::arm("motoman-l3");
    const ArmReach found = reached(l3, {test::around_the_base(600.0, 300.0, 0.0, 1.2 * pi)});
    ASSERT_FALSE(found.holes.empty());
    EXPECT_EQ(found.holes.front().trouble, ArmTrouble::jump);
    EXPECT_GT(to_degrees(found.holes.front().first().off.joint.beyond), 90.0);
    EXPECT_THAT(to_text(l3, ArmTrouble::jump, found.holes.front().first().off), HasSubstr(" jumps by "));
}

/// Arms without a closed form: what the search finds is compared with what their geometry says.
TEST(ArmReachOfAnyArm, SeesThatAJointIsAtItsLimit) {
    const ArmModel scara = test::arm("scara"); // its quill ends 150 mm above the base
    const ArmReach found =
        reached(scara, {test::line_way(Vec3(400.0, 100.0, 300.0), Vec3(400.0, 100.0, 50.0), -Vec3::UnitZ())});
    ASSERT_EQ(found.holes.size(), 1U);
    const ArmHole& hole = found.holes.front();
    EXPECT_EQ(hole.trouble, ArmTrouble::joint_limit);
    EXPECT_NEAR(hole.first().tip.z(), 150.0, 0.5);
    for (const ArmReachPoint& at : hole.points) {
        EXPECT_EQ(at.off.joint.joint, 2);
        EXPECT_NEAR(at.off.joint.beyond, 150.0 - at.tip.z(), 1e-6);
    }
    EXPECT_EQ(to_text(scara, hole.trouble, hole.worst().off), "joint 3 is 100.000 mm beyond its limit");
}

TEST(ArmReachOfAnyArm, MeasuresTheDistanceBeyondTheReach) {
    const ArmModel scara = test::arm("scara"); // links of 325 and 275 mm
    const ArmReach found = reached(
        scara, {test::line_way(Vec3(400.0, 300.0, 250.0), Vec3(640.0, 480.0, 250.0), -Vec3::UnitZ())});
    ASSERT_EQ(found.holes.size(), 1U);
    EXPECT_EQ(found.holes.front().trouble, ArmTrouble::out_of_reach);
    EXPECT_NEAR(found.holes.front().first().tip.head<2>().norm(), 600.0, 0.5);
    for (const ArmReachPoint& at : found.holes.front().points) {
        EXPECT_NEAR(at.off.tip, at.tip.head<2>().norm() - 600.0, 1e-3);
    }
}

TEST(ArmReachOfAnyArm, MeasuresItWithTheToolInItsDirection) {
    const ArmModel six = test::arm("six-axis");
    const ArmReach found =
        reached(six, {test::line_way(Vec3(600.0, 0.0, 500.0), Vec3(1200.0, 0.0, 500.0), -Vec3::UnitZ())});
    ASSERT_EQ(found.holes.size(), 1U);
    EXPECT_EQ(found.holes.front().trouble, ArmTrouble::out_of_reach);
    const double longest = 455.0 + std::hypot(35.0, 420.0);
    for (const ArmReachPoint& at : found.holes.front().points) {
        const Vec3 wrist = at.tip + Vec3(0.0, 0.0, 80.0 + 120.0); // joint 6 and the tool hang from it
        EXPECT_NEAR(at.off.tip, (wrist - Vec3(25.0, 0.0, 400.0)).norm() - longest, 0.05);
        EXPECT_EQ(at.off.axis, 0.0);
    }
}

TEST(ArmReachOfAnyArm, SeesThatTheToolCannotPointThere) {
    const ArmModel scara = test::arm("scara");
    const Vec3 leaning(std::sin(0.2), 0.0, -std::cos(0.2));
    const std::vector<ArmWay> ways{
        test::line_way(Vec3(400.0, 100.0, 250.0), Vec3(400.0, -100.0, 250.0), leaning)};
    const ArmReach found = reached(scara, ways);
    ASSERT_EQ(found.holes.size(), 1U);
    EXPECT_EQ(found.holes.front().trouble, ArmTrouble::tool_axis);
    EXPECT_NEAR(found.holes.front().worst().off.axis, 0.2, 1e-6);
    ArmPathSettings loose;
    loose.aim.most_tilt = 0.21;
    const ArmReach turned = reached(scara, ways, loose);
    EXPECT_TRUE(turned.holes.empty());
    EXPECT_NEAR(turned.most_tilt, 0.2, 1e-6);
}

} // namespace
} // namespace millwright::arm
