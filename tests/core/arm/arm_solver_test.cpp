#include "core/arm/arm_solver.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::arm {
namespace {

struct Case {
    const char* arm;
    ArmDemand demand;
};

class ArmSolver : public ::testing::TestWithParam<Case> {};

TEST_P(ArmSolver, ReturnsFromNearbyAndStaysInsideTheLimits) {
    const ArmModel arm = test::arm(GetParam().arm);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> off(-0.2, 0.2);
    int converged = 0;
    constexpr int goals = 300;
    for (int n = 0; n < goals; ++n) {
        const JointPositions q = test::random_joints(random, arm, 0.8);
        JointPositions start = q;
        for (double& value : start) {
            value += off(random);
        }
        const Frame goal = base_T_tool(arm, q);
        const ArmSolverResult found = solve_arm(arm, goal, GetParam().demand, start);
        EXPECT_EQ(arm.joint_outside(found.positions), -1);
        if (!found.converged) {
            continue;
        }
        ++converged;
        const Frame back = base_T_tool(arm, found.positions);
        EXPECT_LT((back.translation() - goal.translation()).norm(), 1e-8);
        if (GetParam().demand != ArmDemand::tip) {
            EXPECT_LT((back.linear().col(2) - goal.linear().col(2)).norm(), 1e-10);
        }
        if (GetParam().demand == ArmDemand::frame) {
            EXPECT_LT((back.linear() - goal.linear()).norm(), 1e-10);
        }
    }
    EXPECT_GT(converged, goals * 95 / 100);
}

INSTANTIATE_TEST_SUITE_P(Shipped,
                         ArmSolver,
                         ::testing::Values(Case{"motoman-l3", ArmDemand::frame},
                                           Case{"motoman-l3", ArmDemand::tip_and_axis},
                                           Case{"six-axis", ArmDemand::frame},
                                           Case{"six-axis", ArmDemand::tip_and_axis},
                                           Case{"six-axis", ArmDemand::tip},
                                           Case{"scara", ArmDemand::frame}));

TEST(ArmSolverOfTheL3, FindsTheBranchesOfTheClosedForm) {
    const ArmModel arm = test::arm("motoman-l3");
    std::mt19937 random(3);
    for (int n = 0; n < 20; ++n) {
        const JointPositions q = test::random_joints(random, arm, 0.6);
        const Frame goal = base_T_tool(arm, q);
        const auto closed = arm_inverse(arm, goal, q).branches;
        const auto sought = solve_arm_from_many_starts(arm, goal, ArmDemand::frame, q, 60);
        for (const JointPositions& branch : closed) {
            EXPECT_TRUE(std::ranges::any_of(sought, [&](const JointPositions& other) {
                // Joint 4 and 5 may be found in another turn.
                return std::ranges::equal(branch, other, [](double a, double b) {
                    return std::abs(std::remainder(a - b, 2.0 * pi)) < 1e-6;
                });
            })) << branch.transpose();
        }
    }
}

// Each roll about the tool axis is a solution: the list had eight of them that looked the same.
TEST(ArmSolverOfTheScara, OneSolutionStandsForEveryRoll) {
    const ArmModel arm = test::arm("scara");
    JointPositions q = JointPositions::Zero(4);
    q << 0.3, 0.9, 60.0, 0.2;
    const Frame goal = base_T_tool(arm, q);
    const auto found = solve_arm_from_many_starts(arm, goal, ArmDemand::tip_and_axis, q, 60);
    ASSERT_EQ(found.size(), 2U); // the elbow to the left and to the right
    EXPECT_LT((found[0] - q).norm(), 1e-6) << found[0].transpose();
    EXPECT_NEAR(found[1][1], -0.9, 1e-6);
    EXPECT_NEAR(found[1][3], 0.2, 1e-6); // no joint turns for nothing
    for (const JointPositions& one : found) {
        EXPECT_LT((base_T_tool(arm, one).translation() - goal.translation()).norm(), 1e-6);
    }
}

/// The tip there and the axis in its direction; the roll is ours.
Frame goal_of(const ArmModel& arm, const JointPositions& q) {
    Frame goal = base_T_tool(arm, q);
    goal.linear() = kinematics::frame_with_roll(goal.linear().col(2), 0.0);
    return goal;
}

// Joint 6 hardly turns: most rolls cannot be had, and some always can.
TEST(ArmSolverOfSixJoints, EveryPoseOfAnArmIsFoundWhereTheRollIsFree) {
    ArmDescription description = test::arm("six-axis").description();
    description.joints[5].min = from_degrees(-30.0);
    description.joints[5].max = from_degrees(30.0);
    const ArmModel arm(description);
    std::mt19937 random(5);
    for (int n = 0; n < 60; ++n) {
        const JointPositions q = test::random_joints(random, arm);
        const Frame goal = goal_of(arm, q);
        const auto found =
            solve_arm_from_many_starts(arm, goal, ArmDemand::tip_and_axis, JointPositions::Zero(6), 50);
        EXPECT_FALSE(found.empty()) << q.transpose();
        for (const JointPositions& one : found) {
            EXPECT_EQ(arm.joint_outside(one), -1);
            EXPECT_LT((base_T_tool(arm, one).translation() - goal.translation()).norm(), 1e-6);
            EXPECT_LT((base_T_tool(arm, one).linear().col(2) - goal.linear().col(2)).norm(), 1e-8);
        }
    }
}

/// Poses whose own joints are not among the solutions, as `arm ik` searches.
int poses_with_a_branch_missing(int poses) {
    constexpr int starts = 200;
    const ArmModel arm = test::arm("six-axis");
    std::mt19937 random(7);
    int missing = 0;
    for (int n = 0; n < poses; ++n) {
        const JointPositions q = test::random_joints(random, arm);
        const JointPositions elsewhere = test::random_joints(random, arm);
        const auto found =
            solve_arm_from_many_starts(arm, base_T_tool(arm, q), ArmDemand::frame, elsewhere, starts);
        const bool is_there = std::ranges::any_of(found, [&](const JointPositions& one) {
            return std::ranges::equal(
                one, q, [](double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)) < 1e-4; });
        });
        missing += is_there ? 0 : 1;
    }
    return missing;
}

TEST(ArmSolverOfSixJoints, MissesNoBranchOfAHundredPoses) {
    EXPECT_EQ(poses_with_a_branch_missing(100), 0);
}
TEST(ArmSolverInFull, MissesNoBranchOfThreeThousandPoses) {
    EXPECT_EQ(poses_with_a_branch_missing(3000), 0);
}

TEST(ArmSolverOfTheL3, SaysThatItFoundNothing) {
    const ArmModel arm = test::arm("motoman-l3");
    Frame far = Frame::Identity();
    far.translation() = Vec3(3000.0, 0.0, 0.0);
    const ArmSolverResult found = solve_arm(arm, far, ArmDemand::tip, test::degrees({20, -50, 60, 0, 0}));
    EXPECT_FALSE(found.converged);
    EXPECT_NEAR(found.tip_error, 1550.0, 1.0); // as near as it gets
    EXPECT_TRUE(solve_arm_from_many_starts(arm, far, ArmDemand::tip, JointPositions::Zero(5), 5).empty());
}

} // namespace
} // namespace millwright::arm
