#include "core/arm/arm_path.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"
#include "tests/support/arm_ways.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::arm {
namespace {

using ::testing::HasSubstr;

const Vec3 straight_down = -Vec3::UnitZ();
const Vec3 straight_up = Vec3::UnitZ();

JointPositions rest(int joints = 5) {
    return JointPositions::Zero(joints);
}

ArmPath followed(const std::vector<ArmWay>& ways, const ArmPathSettings& settings = {}) {
    return follow_path_well(test::arm("motoman-l3"), ways, rest(), settings, {});
}

/// The farthest that the tip is from the line through `a` and `b` while the joints go straight from point to
/// point.
double farthest_from_line(const ArmModel& arm, const ArmPath& path, const Vec3& a, const Vec3& b) {
    double farthest = 0.0;
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        for (int k = 0; k <= 16; ++k) {
            const double u = k / 16.0;
            const JointPositions q = (1.0 - u) * path.points[n - 1].joints + u * path.points[n].joints;
            const Vec3 tip = base_T_tool(arm, q).translation();
            farthest = std::max(farthest, (tip - a).cross((b - a).normalized()).norm());
        }
    }
    return farthest;
}

TEST(ArmPath, StaysOnALineBetweenItsPointsToo) {
    const Vec3 a(800.0, -300.0, -100.0), b(500.0, 600.0, 200.0);
    for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
        const ArmPath path = followed({test::line_way(a, b, straight_down)},
                                      {.tip_tolerance = tolerance, .longest_step = 100.0});
        ASSERT_TRUE(path.whole());
        EXPECT_EQ(path.points.front().share, 0.0);
        EXPECT_EQ(path.points.back().share, 1.0);
        // Half way is not always the farthest place; nearly it is.
        EXPECT_LE(farthest_from_line(test::arm("motoman-l3"), path, a, b), 1.1 * tolerance);
        for (const ArmPathPoint& point : path.points) {
            const Vec3 should = a + point.share * (b - a);
            EXPECT_LE((base_T_tool(test::arm("motoman-l3"), point.joints).translation() - should).norm(),
                      1e-9);
        }
    }
}

TEST(ArmPath, TellsWhereItsReachEnds) {
    const ArmPath path =
        followed({test::line_way(Vec3(1000.0, 0.0, 0.0), Vec3(2000.0, 0.0, 0.0), straight_down)});
    ASSERT_EQ(path.findings.size(), 1U);
    const ArmFinding& finding = path.findings.front();
    EXPECT_EQ(finding.trouble, ArmTrouble::out_of_reach);
    EXPECT_THAT(finding.why, HasSubstr("the arm reaches from 291.924 to 1450.000"));
    EXPECT_NEAR(1000.0 + 1000.0 * path.points[finding.first].share, 1450.0, 0.5);
    EXPECT_EQ(finding.last, path.points.size() - 1);
}

TEST(ArmPath, GoesOnBehindAHole) {
    // Joint 3 ends at 160 deg, and so does the reach inwards; 100 mm beside the shoulder is a hole.
    const ArmPath path =
        followed({test::line_way(Vec3(400.0, 100.0, 0.0), Vec3(-400.0, 100.0, 0.0), straight_up)});
    ASSERT_EQ(path.findings.size(), 3U);
    EXPECT_EQ(path.findings[0].trouble, ArmTrouble::joint_limit);
    EXPECT_EQ(path.findings[1].trouble, ArmTrouble::out_of_reach);
    const double nearest =
        650.0 * 650.0 + 800.0 * 800.0 + 2.0 * 650.0 * 800.0 * std::cos(from_degrees(160.0));
    const double half = std::sqrt(nearest - 100.0 * 100.0);
    EXPECT_NEAR(400.0 - 800.0 * path.points[path.findings[0].first].share, half, 0.5);
    EXPECT_NEAR(400.0 - 800.0 * path.points[path.findings[2].last + 1].share, -half, 0.5);
    EXPECT_EQ(path.points.back().trouble, ArmTrouble::none);
}

TEST(ArmPath, TurnsTheBaseWherePathsPassItsAxis) {
    const Vec3 a(1.0, -300.0, 700.0), b(1.0, 300.0, 700.0);
    const ArmPath path = followed({test::line_way(a, b, straight_up)});
    ASSERT_TRUE(path.whole()) << path.findings.front().why;
    EXPECT_LE(farthest_from_line(test::arm("motoman-l3"), path, a, b), 0.011);
    double fastest = 0.0;
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        const double turn = path.points[n].joints[0] - path.points[n - 1].joints[0];
        fastest = std::max(fastest, std::abs(turn) / length_to(path, {test::line_way(a, b, straight_up)}, n));
    }
    // Next to the axis the base turns by 1 rad / r a mm.
    EXPECT_NEAR(fastest, 1.0, 0.05);
}

TEST(ArmPath, RefusesToJumpToAnotherBranch) {
    // The base ends at 175 deg: only over its back does the arm reach the rest.
    const ArmPath path = followed({test::around_the_base(600.0, 300.0, 0.0, 1.2 * pi)});
    ASSERT_FALSE(path.whole());
    EXPECT_EQ(path.findings.front().trouble, ArmTrouble::jump);
    EXPECT_THAT(path.findings.front().why, HasSubstr("deg within 0.000"));
    EXPECT_NEAR(to_degrees(1.2 * pi * path.points[path.findings.front().first].share), 175.0, 1e-3);
}

TEST(ArmPath, NamesTheLimitWhereNoBranchIsLeft) {
    const Vec3 a(900.0, 0.0, 0.0), b(900.0, 0.0, -900.0);
    ArmDescription narrow = test::arm("motoman-l3").description();
    narrow.joints[1].max = from_degrees(-30.0);
    narrow.joints[0].min = from_degrees(-90.0);
    narrow.joints[0].max = from_degrees(90.0);
    const ArmPath path =
        follow_path_well(ArmModel(narrow), {test::line_way(a, b, straight_down)}, rest(), {}, {});
    ASSERT_FALSE(path.whole());
    EXPECT_EQ(path.findings.front().trouble, ArmTrouble::joint_limit);
    EXPECT_THAT(path.findings.front().why, HasSubstr("joint 2 would have to move to"));
}

TEST(ArmPath, TurnsTheToolAxisAsFarAsItMay) {
    const Vec3 leaning = Vec3(0.0, std::sin(0.05), -std::cos(0.05));
    const std::vector<ArmWay> ways{
        test::line_way(Vec3(700.0, -10.0, 100.0), Vec3(700.0, 10.0, 100.0), leaning)};
    const ArmPath strict = followed(ways);
    ASSERT_FALSE(strict.whole());
    EXPECT_EQ(strict.findings.front().trouble, ArmTrouble::tool_axis);
    EXPECT_THAT(strict.findings.front().why, HasSubstr("2.86"));
    ArmPathSettings loose;
    loose.aim.most_tilt = 0.06;
    const ArmPath allowed = followed(ways, loose);
    ASSERT_TRUE(allowed.whole());
    const auto most = std::ranges::max_element(allowed.points, {}, &ArmPathPoint::tilt);
    EXPECT_NEAR(most->tilt, 0.05, 1e-3);
}

TEST(ArmPath, BeginsWithTheBranchThatLeadsFarthest) {
    // From rest the front is nearer, but a base at 100 deg cannot go on to 200; over its back it can.
    const std::vector<ArmWay> ways{
        test::around_the_base(600.0, 300.0, from_degrees(100.0), from_degrees(200.0))};
    JointPositions front = all_holds(test::arm("motoman-l3"), ways[0].at(0.0), {}, rest()).front();
    front[0] = from_degrees(100.0);
    const ArmPath from_front =
        follow_path(test::arm("motoman-l3"),
                    ways,
                    all_holds(test::arm("motoman-l3"), ways[0].at(0.0), {}, front).front(),
                    {},
                    {});
    EXPECT_FALSE(from_front.whole());
    EXPECT_TRUE(followed(ways).whole());
}

TEST(ArmPath, ArmsWithoutAClosedFormFollowToo) {
    const ArmModel six = test::arm("six-axis");
    const Vec3 a = base_T_tool(six, JointPositions::Constant(6, 0.3)).translation();
    const Vec3 b = a + Vec3(30.0, -40.0, 20.0);
    const ArmPath path = follow_path_well(six, {test::line_way(a, b, straight_down)}, rest(6), {}, {});
    ASSERT_TRUE(path.whole()) << path.findings.front().why;
    EXPECT_LE(farthest_from_line(six, path, a, b), 0.011);
}

/// From a straight arm no small motion of its joints leads inwards.
TEST(ArmPath, LeavesAStretchedArm) {
    const ArmModel scara = test::arm("scara");
    Frame goal = Frame::Identity();
    goal.translation() = Vec3(400.0, 0.0, 250.0);
    goal.linear() = frame_along(straight_down);
    const ArmHold hold = hold_tool(scara, goal, {}, rest(4));
    ASSERT_EQ(hold.trouble, ArmTrouble::none) << hold.why;
    EXPECT_LT((base_T_tool(scara, hold.joints).translation() - goal.translation()).norm(), 1e-8);
}

TEST(ArmPath, IsStoppedWhereItNeedsTooManyPoints) {
    const std::vector<ArmWay> ways{
        test::line_way(Vec3(800.0, 0.0, 0.0), Vec3(900.0, 0.0, 0.0), straight_down)};
    EXPECT_THROW((void)followed(ways, {.longest_step = 0.1, .most_points = 500}), Error);
}

TEST(ArmPath, IsTheSameWhereTheToolTurnsOnTheSpot) {
    ArmWay turn;
    turn.at = [](double share) {
        Frame tool = Frame::Identity();
        tool.translation() = Vec3(800.0, 0.0, 200.0);
        tool.linear() = Eigen::AngleAxisd(pi * (1.0 - 0.5 * share), Vec3::UnitY()).toRotationMatrix();
        return tool;
    };
    const ArmPath path = followed({turn});
    ASSERT_TRUE(path.whole()) << path.findings.front().why;
    EXPECT_GE(path.points.size(), 16U);
}

/// The tip stays, and the tool is tilted from 20 degrees on the side of `azimuth` over the upright to 20
/// degrees on the other, with the same roll all the way; it passes `beside` the upright, rad.
ArmWay tilted_past_the_upright(const Vec3& tip, double azimuth, double beside) {
    ArmWay way;
    way.at = [=](double share) {
        const double tilt = from_degrees(20.0 - 40.0 * share);
        const Vec3 outwards(std::cos(azimuth), std::sin(azimuth), 0.0);
        const Vec3 across(-std::sin(azimuth), std::cos(azimuth), 0.0);
        const Vec3 level = std::sin(tilt) * outwards + std::sin(beside) * across;
        const Vec3 axis = (level + std::cos(tilt) * Vec3::UnitZ()).normalized();
        Frame tool = Frame::Identity();
        tool.translation() = tip;
        tool.linear() = kinematics::frame_with_roll(axis, 0.4);
        return tool;
    };
    return way;
}

TEST(ArmPath, KeepsARollPastTheUprightToolOnEachOfFourSides) {
    const ArmPathSettings keeping_roll{.aim = {.demand = ArmDemand::frame}};
    for (const double azimuth : {0.0, 0.5 * pi, pi, -0.5 * pi}) {
        const bool to_the_side = std::abs(std::sin(azimuth)) > 0.5;
        const Vec3 in_plane = to_the_side ? Vec3(0.0, 800.0, 300.0) : Vec3(800.0, 0.0, 300.0);
        const ArmPath of_five = follow_path_well(test::arm("motoman-l3"),
                                                 {tilted_past_the_upright(in_plane, azimuth, 0.0)},
                                                 rest(),
                                                 keeping_roll,
                                                 {});
        EXPECT_TRUE(of_five.whole()) << azimuth << ": " << of_five.findings.front().why;
        for (const double beside : {0.0, 1e-6, 0.01}) {
            const ArmPath of_six =
                follow_path_well(test::arm("six-axis"),
                                 {tilted_past_the_upright(Vec3(550.0, 0.0, 900.0), azimuth, beside)},
                                 rest(6),
                                 keeping_roll,
                                 {});
            EXPECT_TRUE(of_six.whole()) << azimuth << ", " << beside << ": " << of_six.findings.front().why;
        }
    }
}

} // namespace
} // namespace millwright::arm
