#include "core/arm/arm_inverse.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

using ::testing::HasSubstr;

/// The L-3 with limits that are out of the way.
ArmModel free_arm(double tool = 0.0) {
    ArmDescription description = test::arm("motoman-l3").description();
    for (ArmJoint& joint : description.joints) {
        joint.min = -2.0 * pi;
        joint.max = 2.0 * pi;
    }
    description.tool_tip = {0.0, 0.0, tool};
    return ArmModel(description);
}

class ArmInverse : public ::testing::Test {
protected:
    ArmModel arm_ = free_arm();
    JointPositions zero_ = JointPositions::Zero(5);
    std::mt19937 random_{42};
};

TEST_F(ArmInverse, K2ReturnsToAMillionPosesByEveryBranch) {
    for (const double length : {0.0, 130.0}) {
        const ArmModel arm = free_arm(length);
        double tip = 0.0, turned = 0.0;
        for (int n = 0; n < 500'000; ++n) {
            const JointPositions q = test::random_joints(random_, arm, 0.5);
            const Frame goal = base_T_tool(arm, q);
            const kinematics::InverseSolution found = arm_inverse(arm, goal, q);
            ASSERT_EQ(found.branches.size(), 4U) << found.why;
            double nearest = 1e300;
            for (const JointPositions& branch : found.branches) {
                const Frame back = base_T_tool(arm, branch);
                tip = std::max(tip, (back.translation() - goal.translation()).norm());
                turned = std::max(turned, (back.linear() - goal.linear()).cwiseAbs().maxCoeff());
                nearest = std::min(nearest, (branch - q).cwiseAbs().maxCoeff());
            }
            ASSERT_LT(nearest, 1e-5) << q.transpose();
        }
        EXPECT_LT(tip, 1e-9);
        EXPECT_LT(turned, 1e-10);
    }
}

TEST_F(ArmInverse, K2TakesElbowUpToTheFrontFirst) {
    const Frame goal = base_T_tool(arm_, test::degrees({30, -60, 80, 20, 45}));
    const kinematics::InverseSolution found = arm_inverse(arm_, goal, zero_);
    ASSERT_EQ(found.branches.size(), 4U);
    EXPECT_LT((found.branches[0] - test::degrees({30, -60, 80, 20, 45})).norm(), 1e-9);
    EXPECT_LT(found.branches[1][2], 0.0);
    EXPECT_NEAR(std::abs(found.branches[2][0] - found.branches[0][0]), pi, 1e-9);
}

TEST_F(ArmInverse, LeavesTheRollAsItIsWhereOnlyTheAxisIsAsked) {
    const JointPositions before = test::degrees({10, -50, 70, 10, 77});
    const kinematics::InverseSolution found =
        arm_inverse(arm_, PointedGoal{{900.0, 200.0, 300.0}, Vec3(0.0, 0.0, -1.0)}, before);
    ASSERT_EQ(found.branches.size(), 4U);
    for (const JointPositions& branch : found.branches) {
        EXPECT_NEAR(branch[4], before[4], 1e-12);
        const Frame back = base_T_tool(arm_, branch);
        EXPECT_LT((back.translation() - Vec3(900.0, 200.0, 300.0)).norm(), 1e-9);
        EXPECT_LT((back.linear().col(2) + Vec3::UnitZ()).norm(), 1e-12);
    }
}

TEST_F(ArmInverse, K5SaysWhyAPoseCannotBeReached) {
    const auto why = [&](const ArmModel& arm, const Vec3& tip, const Vec3& axis) {
        const kinematics::InverseSolution found = arm_inverse(arm, PointedGoal{tip, axis}, zero_);
        EXPECT_TRUE(found.branches.empty());
        EXPECT_NE(found.reach, kinematics::Reach::reachable);
        return found.why;
    };
    EXPECT_THAT(why(arm_, {1500.0, 0.0, 0.0}, Vec3::UnitZ()), HasSubstr("1500.000 mm from the shoulder"));
    EXPECT_THAT(why(arm_, {100.0, 0.0, 0.0}, Vec3::UnitZ()), HasSubstr("reaches from 150.000 to 1450.000"));
    EXPECT_THAT(why(arm_, {800.0, 0.0, 0.0}, Vec3(0.0, 0.6, 0.8)), HasSubstr("36.8699 deg out of the plane"));
    EXPECT_THAT(why(test::arm("motoman-l3"), {0.0, 0.0, -1440.0}, Vec3::UnitZ()), HasSubstr("joint 2"));
}

TEST_F(ArmInverse, K5HoldsAtItsSingularPoses) {
    const JointPositions before = test::degrees({25, -90, 60, 0, 5});
    kinematics::InverseSolution found =
        arm_inverse(arm_, PointedGoal{{0.0, 0.0, 900.0}, Vec3::UnitZ()}, before);
    EXPECT_EQ(found.reach, kinematics::Reach::singular); // above the base: joint 1 stays
    ASSERT_FALSE(found.branches.empty());
    EXPECT_NEAR(found.branches[0][0], before[0], 1e-12);
    // There the tool axis tells how the base has to stand.
    found = arm_inverse(arm_, PointedGoal{{0.0, 0.0, 900.0}, Vec3(0.0, 1.0, 0.0)}, before);
    EXPECT_EQ(found.reach, kinematics::Reach::reachable);
    EXPECT_NEAR(found.branches[0][0], 0.5 * pi, 1e-12);
    for (const double far : {1450.0, 150.0}) { // stretched and folded: both elbows are one
        found = arm_inverse(arm_, PointedGoal{{far, 0.0, 0.0}, Vec3::UnitX()}, before);
        EXPECT_EQ(found.branches.size(), 2U);
        for (const JointPositions& branch : found.branches) {
            EXPECT_LT((base_T_tool(arm_, branch).translation() - Vec3(far, 0.0, 0.0)).norm(), 1e-6);
        }
    }
}

TEST_F(ArmInverse, GivesTheTurnNearestToWhereTheArmStands) {
    const Frame goal = base_T_tool(arm_, test::degrees({0, -60, 80, 20, 170}));
    const kinematics::InverseSolution found = arm_inverse(arm_, goal, test::degrees({0, -60, 80, 20, -200}));
    EXPECT_NEAR(to_degrees(found.branches[0][4]), -190.0, 1e-9);
}

TEST_F(ArmInverse, BelongsToArmsOfItsKindOnly) {
    const ArmModel six = test::arm("six-axis");
    EXPECT_FALSE(six.planar_elbow());
    EXPECT_THROW((void)arm_inverse(six, Frame::Identity(), JointPositions::Zero(6)), Defect);
    Frame no_motion = Frame::Identity();
    no_motion.linear() *= 2.0;
    EXPECT_THROW((void)arm_inverse(arm_, no_motion, zero_), Defect);
}

TEST_F(ArmInverse, K4ReachesProjectedGoals) {
    for (int n = 0; n < 5000; ++n) {
        Frame goal = base_T_tool(arm_, test::random_joints(random_, arm_, 0.5));
        const Vec3 turn = Vec3::Random();
        goal.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * goal.linear();
        const auto projected = projected_goal(goal);
        ASSERT_TRUE(projected);
        EXPECT_FALSE(arm_inverse(arm_, *projected, zero_).branches.empty());
        EXPECT_TRUE(projected->linear().isUnitary(1e-12));
        // The smallest turn is the angle between the axis and the plane.
        const Vec3 m = Vec3(-goal.translation().y(), goal.translation().x(), 0.0).normalized();
        const double out = std::abs(std::asin(m.dot(goal.linear().col(2))));
        const Eigen::AngleAxisd turned(Mat3(projected->linear() * goal.linear().transpose()));
        EXPECT_NEAR(std::abs(turned.angle()), out, 1e-7);
        EXPECT_NEAR(m.dot(projected->linear().col(2)), 0.0, 1e-12);
    }
}

TEST_F(ArmInverse, K4ProjectsNoAxisAcrossThePlane) {
    Frame goal = Frame::Identity();
    goal.translation() = Vec3(800.0, 0.0, 100.0);
    goal.linear() = frame_along(Vec3::UnitY());
    EXPECT_FALSE(projected_goal(goal));
    goal.translation() = Vec3(0.0, 0.0, 900.0);
    EXPECT_TRUE(projected_goal(goal)); // above the base any plane will do
}

} // namespace
} // namespace millwright::arm
