#include "ui/actions/arm_bench.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/tool_roll.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::actions {
namespace {

class ArmBenchTest : public ::testing::Test {
protected:
    ArmBenchTest() : bench_("assets") { bench_.load("motoman-l3"); }

    [[nodiscard]] Vec3 tip() const { return bench_.tool().translation(); }
    /// The farthest that the tip was from the straight way to where it ended.
    double farthest_off_the_line() {
        const Vec3 from = tip();
        std::vector<Vec3> points;
        while (bench_.advance(0.02)) {
            points.push_back(tip());
        }
        const Vec3 way = (tip() - from).normalized();
        double farthest = 0.0;
        for (const Vec3& point : points) {
            farthest = std::max(farthest, (point - from - way.dot(point - from) * way).norm());
        }
        return farthest;
    }

    ArmBench bench_;
};

TEST_F(ArmBenchTest, FindsEverySolutionOfAGoalAndNamesItsBranch) {
    bench_.set_goal(Vec3(800.0, 0.0, 650.0), Vec3::UnitZ());
    ASSERT_EQ(bench_.solutions().size(), 2U); // as `millwright arm ik`
    EXPECT_EQ(bench_.solutions()[0].branch, "front, elbow up");
    EXPECT_EQ(bench_.solutions()[1].branch, "front, elbow down");
    EXPECT_NEAR(bench_.solutions()[0].farthest_turn, 0.0, 1e-9); // where it stands
    for (const ArmSolution& solution : bench_.solutions()) {
        const Frame there = arm::base_T_tool(bench_.arm(), solution.joints);
        EXPECT_LT((there.translation() - Vec3(800.0, 0.0, 650.0)).norm(), 1e-9);
    }
}

TEST_F(ArmBenchTest, TellsSlidesInMillimetres) {
    bench_.load("scara");
    const Frame tool = bench_.tool();
    bench_.set_goal(tool.translation() - Vec3(0.0, 0.0, 40.0), tool.linear().col(2));
    ASSERT_FALSE(bench_.solutions().empty()) << bench_.reason();
    EXPECT_LE(bench_.solutions().size(), 2U);
    EXPECT_NEAR(bench_.solutions()[0].farthest_slide, 40.0, 1e-6);
    EXPECT_NEAR(bench_.solutions()[0].farthest_turn, 0.0, 1e-6);
}

TEST_F(ArmBenchTest, SaysWhyThereIsNoSolution) {
    bench_.set_goal(Vec3(1500.0, 0.0, 0.0), Vec3::UnitZ());
    EXPECT_TRUE(bench_.solutions().empty());
    EXPECT_NE(bench_.reason().find("1450"), std::string::npos);
    bench_.set_goal(Vec3(800.0, 0.0, 0.0), Vec3::Zero());
    EXPECT_NE(bench_.reason().find("no direction"), std::string::npos);
    EXPECT_EQ(bench_.chosen(), -1);
    EXPECT_THROW(bench_.go(ArmMove::joints), Error);
}

TEST_F(ArmBenchTest, TurnsAnAxisIntoItsPlaneOnlyIfItMay) {
    const Vec3 across(0.0, 0.6, 0.8);
    bench_.set_goal(Vec3(800.0, 100.0, 0.0), across);
    EXPECT_FALSE(bench_.solutions().empty());
    bench_.set_projects(false);
    EXPECT_TRUE(bench_.solutions().empty());
    EXPECT_NE(bench_.reason().find("out of the plane"), std::string::npos);
}

TEST_F(ArmBenchTest, HoldsTheRollOfAGoalWhereOneIsAskedFor) {
    arm::JointPositions there(5);
    there << from_degrees(30.0), from_degrees(-60.0), from_degrees(80.0), from_degrees(20.0),
        from_degrees(45.0);
    const Frame wanted = arm::base_T_tool(bench_.arm(), there);
    bench_.set_goal(wanted.translation(), wanted.linear().col(2));
    ASSERT_FALSE(bench_.solutions().empty());
    EXPECT_NEAR(bench_.solutions()[0].joints[4], 0.0, 1e-9); // any roll: joint 5 stays
    bench_.set_goal_roll(kinematics::roll_of(wanted.linear()));
    ASSERT_GE(bench_.solutions().size(), 2U);
    EXPECT_LT((bench_.solutions()[0].joints - there).norm(), 1e-9);
    for (const ArmSolution& solution : bench_.solutions()) {
        const Frame back = arm::base_T_tool(bench_.arm(), solution.joints);
        EXPECT_LT((back.matrix() - wanted.matrix()).cwiseAbs().maxCoeff(), 1e-9);
    }
    // Of an axis that has to be turned into the plane the roll is that about the turned one.
    bench_.set_goal(Vec3(800.0, 100.0, 0.0), Vec3(0.0, 0.6, 0.8));
    bench_.set_goal_roll(from_degrees(25.0));
    ASSERT_FALSE(bench_.solutions().empty());
    for (const ArmSolution& solution : bench_.solutions()) {
        const Mat3 held = arm::base_T_tool(bench_.arm(), solution.joints).linear();
        EXPECT_NEAR(to_degrees(kinematics::roll_of(held)), 25.0, 1e-6);
        EXPECT_LT((held.col(2) - bench_.goal()->axis).norm(), 1e-9);
    }
    bench_.set_joints(there);
    bench_.set_goal_from_tool();
    EXPECT_NEAR(*bench_.goal_roll(), kinematics::roll_of(wanted.linear()), 1e-12);
    bench_.set_goal_roll(std::nullopt);
    EXPECT_FALSE(bench_.solutions().empty());
}

TEST_F(ArmBenchTest, GoesInALineWhereItIsToldTo) {
    bench_.set_goal(Vec3(700.0, -300.0, 300.0), Vec3::UnitZ());
    bench_.go(ArmMove::straight);
    EXPECT_LT(farthest_off_the_line(), 0.05);
    EXPECT_LT((tip() - Vec3(700.0, -300.0, 300.0)).norm(), 1e-6);
    bench_.set_goal(Vec3(800.0, 300.0, 500.0), Vec3::UnitZ());
    bench_.go(ArmMove::joints);
    EXPECT_GT(farthest_off_the_line(), 1.0);
    EXPECT_FALSE(bench_.moving());
}

TEST_F(ArmBenchTest, AJogThatIsNotWantedAnyMoreStops) {
    arm::JointPositions rates = arm::JointPositions::Zero(5);
    rates[0] = 0.5;
    bench_.hold_jog(rates);
    EXPECT_TRUE(bench_.advance(0.1));
    EXPECT_NEAR(bench_.joints()[0], 0.05, 1e-12);
    EXPECT_FALSE(bench_.advance(0.1));
    EXPECT_NEAR(bench_.joints()[0], 0.05, 1e-12);
}

TEST_F(ArmBenchTest, AHeldLineIsStraightHoweverSlowTheFramesAre) {
    bench_.set_joints((arm::JointPositions(5) << 0.2, -1.2, 1.0, 0.3, 0.0).finished());
    for (const Vec3& velocity : {Vec3(0.0, 0.0, -100.0), Vec3(100.0, 0.0, 0.0), Vec3(0.0, -100.0, 0.0)}) {
        const Vec3 from = tip(), along = velocity.normalized();
        for (int n = 0; n < 20; ++n) {
            bench_.hold_line(velocity);
            ASSERT_TRUE(bench_.advance(0.1)) << bench_.refusal();
        }
        EXPECT_NEAR(along.dot(tip() - from), 200.0, 1e-6) << bench_.refusal();
        EXPECT_LT((tip() - from).cross(along).norm(), 1e-6);
        EXPECT_FALSE(bench_.advance(0.1)); // it is wanted no more
        bench_.move_tip_by(10.0 * along);
        EXPECT_NEAR(along.dot(tip() - from), 210.0, 1e-6);
        EXPECT_LT((tip() - from).cross(along).norm(), 1e-6);
    }
}

TEST_F(ArmBenchTest, AHeldLineEndsAtTheBorderOfTheReachAndLeavesItNot) {
    const Vec3 from = tip();
    for (int n = 0; n < 100; ++n) {
        bench_.hold_line(Vec3(100.0, 0.0, 0.0));
        (void)bench_.advance(0.1);
    }
    EXPECT_FALSE(bench_.refusal().empty());
    EXPECT_NEAR(tip().y(), from.y(), 1e-6);
    EXPECT_NEAR(tip().z(), from.z(), 1e-6);
}

TEST_F(ArmBenchTest, StaysInsideTheLimitsAndSaysSo) {
    bench_.set_joint(0, 10.0);
    EXPECT_DOUBLE_EQ(bench_.joints()[0], bench_.arm().joint(0).max);
    EXPECT_EQ(bench_.refusal(), "Joint 1 is at its limit.");
    bench_.set_joint(0, 0.0);
    EXPECT_TRUE(bench_.refusal().empty());
}

TEST_F(ArmBenchTest, MovesItsTipAndKeepsTheLean) {
    bench_.move_tip(Vec3(500.0, 500.0, 400.0));
    EXPECT_LT((tip() - Vec3(500.0, 500.0, 400.0)).norm(), 1e-9);
    EXPECT_NEAR(bench_.tool().linear().col(2).z(), 1.0, 1e-9);
    const Vec3 before = tip();
    bench_.move_tip(Vec3(3000.0, 0.0, 0.0));
    EXPECT_FALSE(bench_.refusal().empty());
    EXPECT_LT((tip() - before).norm(), 1e-12);
}

TEST_F(ArmBenchTest, FollowsWhatAControllerTellsOfSomeJoints) {
    bench_.set_joint(4, 1.0);
    arm::JointPositions told(4);
    told << 0.1, -1.0, 1.2, 0.3;
    bench_.follow(told);
    EXPECT_LT((bench_.joints().head(4) - told).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(bench_.joints()[4], 1.0);
}

TEST_F(ArmBenchTest, ATraceBeginsAnewWhereThePositionBecomesKnown) {
    const auto points = [this] {
        const auto trace = bench_.scene().trace;
        return trace ? trace->size() : 0;
    };
    const auto told = [](double first) {
        return arm::JointPositions(arm::JointPositions::Constant(4, first));
    };
    bench_.clear_trace();
    bench_.follow(told(0.1), false);
    bench_.follow(told(0.2), false);
    EXPECT_EQ(points(), 0);
    bench_.follow(told(-0.4), true);
    bench_.follow(told(-0.3), true);
    EXPECT_EQ(points(), 2);
    bench_.follow(told(-0.2), false); // the link is lost: what was seen stays in sight
    EXPECT_EQ(points(), 2);
    bench_.follow(told(0.5), true);
    EXPECT_EQ(points(), 1);
}

TEST_F(ArmBenchTest, AnArmThatCannotBeReadLeavesTheOldOne) {
    EXPECT_THROW(bench_.load("no-such-arm"), Error);
    EXPECT_EQ(bench_.name(), "motoman-l3");
}

} // namespace
} // namespace millwright::actions
