#include "ui/workspaces/arm_workspace.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::actions {
namespace {

class ArmWorkspaceTest : public ::testing::Test {
protected:
    ArmWorkspaceTest() : workspace_("assets") { workspace_.load("motoman-l3"); }

    [[nodiscard]] Vec3 tip() const { return workspace_.tool().translation(); }
    /// The farthest that the tip was from the straight way to where it ended.
    double farthest_off_the_line() {
        const Vec3 from = tip();
        std::vector<Vec3> points;
        while (workspace_.advance(0.02)) {
            points.push_back(tip());
        }
        const Vec3 way = (tip() - from).normalized();
        double farthest = 0.0;
        for (const Vec3& point : points) {
            farthest = std::max(farthest, (point - from - way.dot(point - from) * way).norm());
        }
        return farthest;
    }

    ArmWorkspace workspace_;
};

TEST_F(ArmWorkspaceTest, FindsEverySolutionOfAGoalAndNamesItsBranch) {
    workspace_.set_goal(Vec3(800.0, 0.0, 650.0), Vec3::UnitZ());
    ASSERT_EQ(workspace_.solutions().size(), 2U); // as `millwright arm ik`
    EXPECT_EQ(workspace_.solutions()[0].branch, "front, elbow up");
    EXPECT_EQ(workspace_.solutions()[1].branch, "front, elbow down");
    EXPECT_NEAR(workspace_.solutions()[0].farthest_turn, 0.0, 1e-9); // its position
    for (const ArmSolution& solution : workspace_.solutions()) {
        const Frame there = arm::base_T_tool(workspace_.arm(), solution.joints);
        EXPECT_LT((there.translation() - Vec3(800.0, 0.0, 650.0)).norm(), 1e-9);
    }
}

TEST_F(ArmWorkspaceTest, TellsSlidesInMillimetres) {
    workspace_.load("scara");
    const Frame tool = workspace_.tool();
    workspace_.set_goal(tool.translation() - Vec3(0.0, 0.0, 40.0), tool.linear().col(2));
    ASSERT_FALSE(workspace_.solutions().empty()) << workspace_.reason();
    EXPECT_LE(workspace_.solutions().size(), 2U);
    EXPECT_NEAR(workspace_.solutions()[0].farthest_slide, 40.0, 1e-6);
    EXPECT_NEAR(workspace_.solutions()[0].farthest_turn, 0.0, 1e-6);
}

TEST_F(ArmWorkspaceTest, SaysWhyThereIsNoSolution) {
    workspace_.set_goal(Vec3(1500.0, 0.0, 0.0), Vec3::UnitZ());
    EXPECT_TRUE(workspace_.solutions().empty());
    EXPECT_NE(workspace_.reason().find("1450"), std::string::npos);
    workspace_.set_goal(Vec3(800.0, 0.0, 0.0), Vec3::Zero());
    EXPECT_NE(workspace_.reason().find("no direction"), std::string::npos);
    EXPECT_EQ(workspace_.chosen(), -1);
    EXPECT_THROW(workspace_.go(ArmMove::joints), Error);
}

TEST_F(ArmWorkspaceTest, TurnsAnAxisIntoItsPlaneOnlyIfItMay) {
    const Vec3 across(0.0, 0.6, 0.8);
    workspace_.set_goal(Vec3(800.0, 100.0, 0.0), across);
    EXPECT_FALSE(workspace_.solutions().empty());
    workspace_.set_projects(false);
    EXPECT_TRUE(workspace_.solutions().empty());
    EXPECT_NE(workspace_.reason().find("out of the plane"), std::string::npos);
}

TEST_F(ArmWorkspaceTest, HoldsTheRollOfAGoalWhereOneIsAskedFor) {
    arm::JointPositions there(5);
    there << from_degrees(30.0), from_degrees(-60.0), from_degrees(80.0), from_degrees(20.0),
        from_degrees(45.0);
    const Frame wanted = arm::base_T_tool(workspace_.arm(), there);
    workspace_.set_goal(wanted.translation(), wanted.linear().col(2));
    ASSERT_FALSE(workspace_.solutions().empty());
    EXPECT_NEAR(workspace_.solutions()[0].joints[4], 0.0, 1e-9); // any roll: joint 5 stays
    workspace_.set_goal_roll(kinematics::roll_of(wanted.linear()));
    ASSERT_GE(workspace_.solutions().size(), 2U);
    EXPECT_LT((workspace_.solutions()[0].joints - there).norm(), 1e-9);
    for (const ArmSolution& solution : workspace_.solutions()) {
        const Frame back = arm::base_T_tool(workspace_.arm(), solution.joints);
        EXPECT_LT((back.matrix() - wanted.matrix()).cwiseAbs().maxCoeff(), 1e-9);
    }
    // Of an axis that has to be turned into the plane the roll is that about the turned one.
    workspace_.set_goal(Vec3(800.0, 100.0, 0.0), Vec3(0.0, 0.6, 0.8));
    workspace_.set_goal_roll(from_degrees(25.0));
    ASSERT_FALSE(workspace_.solutions().empty());
    for (const ArmSolution& solution : workspace_.solutions()) {
        const Mat3 held = arm::base_T_tool(workspace_.arm(), solution.joints).linear();
        EXPECT_NEAR(to_degrees(kinematics::roll_of(held)), 25.0, 1e-6);
        EXPECT_LT((held.col(2) - workspace_.goal()->axis).norm(), 1e-9);
    }
    workspace_.set_joints(there);
    workspace_.set_goal_from_tool();
    EXPECT_NEAR(*workspace_.goal_roll(), kinematics::roll_of(wanted.linear()), 1e-12);
    workspace_.set_goal_roll(std::nullopt);
    EXPECT_FALSE(workspace_.solutions().empty());
}

TEST_F(ArmWorkspaceTest, GoesInALineWhereItIsToldTo) {
    workspace_.set_goal(Vec3(700.0, -300.0, 300.0), Vec3::UnitZ());
    workspace_.go(ArmMove::straight);
    EXPECT_LT(farthest_off_the_line(), 0.05);
    EXPECT_LT((tip() - Vec3(700.0, -300.0, 300.0)).norm(), 1e-6);
    workspace_.set_goal(Vec3(800.0, 300.0, 500.0), Vec3::UnitZ());
    workspace_.go(ArmMove::joints);
    EXPECT_GT(farthest_off_the_line(), 1.0);
    EXPECT_FALSE(workspace_.moving());
}

TEST_F(ArmWorkspaceTest, AJogThatIsNotWantedAnyMoreStops) {
    arm::JointPositions rates = arm::JointPositions::Zero(5);
    rates[0] = 0.5;
    workspace_.hold_jog(rates);
    EXPECT_TRUE(workspace_.advance(0.1));
    EXPECT_NEAR(workspace_.joints()[0], 0.05, 1e-12);
    EXPECT_FALSE(workspace_.advance(0.1));
    EXPECT_NEAR(workspace_.joints()[0], 0.05, 1e-12);
}

TEST_F(ArmWorkspaceTest, AHeldLineIsStraightHoweverSlowTheFramesAre) {
    workspace_.set_joints((arm::JointPositions(5) << 0.2, -1.2, 1.0, 0.3, 0.0).finished());
    for (const Vec3& velocity : {Vec3(0.0, 0.0, -100.0), Vec3(100.0, 0.0, 0.0), Vec3(0.0, -100.0, 0.0)}) {
        const Vec3 from = tip(), along = velocity.normalized();
        for (int n = 0; n < 20; ++n) {
            workspace_.hold_line(velocity);
            ASSERT_TRUE(workspace_.advance(0.1)) << workspace_.refusal();
        }
        EXPECT_NEAR(along.dot(tip() - from), 200.0, 1e-6) << workspace_.refusal();
        EXPECT_LT((tip() - from).cross(along).norm(), 1e-6);
        EXPECT_FALSE(workspace_.advance(0.1)); // it is wanted no more
        workspace_.move_tip_by(10.0 * along);
        EXPECT_NEAR(along.dot(tip() - from), 210.0, 1e-6);
        EXPECT_LT((tip() - from).cross(along).norm(), 1e-6);
    }
}

TEST_F(ArmWorkspaceTest, AHeldLineEndsAtTheBorderOfTheReachAndLeavesItNot) {
    const Vec3 from = tip();
    for (int n = 0; n < 100; ++n) {
        workspace_.hold_line(Vec3(100.0, 0.0, 0.0));
        (void)workspace_.advance(0.1);
    }
    EXPECT_FALSE(workspace_.refusal().empty());
    EXPECT_NEAR(tip().y(), from.y(), 1e-6);
    EXPECT_NEAR(tip().z(), from.z(), 1e-6);
}

TEST_F(ArmWorkspaceTest, StaysInsideTheLimitsAndSaysSo) {
    workspace_.set_joint(0, 10.0);
    EXPECT_DOUBLE_EQ(workspace_.joints()[0], workspace_.arm().joint(0).max);
    EXPECT_EQ(workspace_.refusal(), "Joint 1 is at its limit.");
    workspace_.set_joint(0, 0.0);
    EXPECT_TRUE(workspace_.refusal().empty());
}

TEST_F(ArmWorkspaceTest, MovesItsTipAndKeepsTheLean) {
    workspace_.move_tip(Vec3(500.0, 500.0, 400.0));
    EXPECT_LT((tip() - Vec3(500.0, 500.0, 400.0)).norm(), 1e-9);
    EXPECT_NEAR(workspace_.tool().linear().col(2).z(), 1.0, 1e-9);
    const Vec3 before = tip();
    workspace_.move_tip(Vec3(3000.0, 0.0, 0.0));
    EXPECT_FALSE(workspace_.refusal().empty());
    EXPECT_LT((tip() - before).norm(), 1e-12);
}

TEST_F(ArmWorkspaceTest, FollowsWhatAControllerTellsOfSomeJoints) {
    workspace_.set_joint(4, 1.0);
    arm::JointPositions told(4);
    told << 0.1, -1.0, 1.2, 0.3;
    workspace_.follow(told);
    EXPECT_LT((workspace_.joints().head(4) - told).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(workspace_.joints()[4], 1.0);
}

TEST_F(ArmWorkspaceTest, ATraceBeginsAnewWhereThePositionBecomesKnown) {
    const auto points = [this] {
        const auto trace = workspace_.scene().trace;
        return trace ? trace->size() : 0;
    };
    const auto told = [](double first) {
        return arm::JointPositions(arm::JointPositions::Constant(4, first));
    };
    workspace_.clear_trace();
    workspace_.follow(told(0.1), false);
    workspace_.follow(told(0.2), false);
    EXPECT_EQ(points(), 0);
    workspace_.follow(told(-0.4), true);
    workspace_.follow(told(-0.3), true);
    EXPECT_EQ(points(), 2);
    workspace_.follow(told(-0.2), false); // the link is lost: what was seen stays in sight
    EXPECT_EQ(points(), 2);
    workspace_.follow(told(0.5), true);
    EXPECT_EQ(points(), 1);
}

TEST_F(ArmWorkspaceTest, AnArmThatCannotBeReadLeavesTheOldOne) {
    EXPECT_THROW(workspace_.load("no-such-arm"), Error);
    EXPECT_EQ(workspace_.name(), "motoman-l3");
}

} // namespace
} // namespace millwright::actions
