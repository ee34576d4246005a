// Orocos KDL as the judge of our arms: the same chain built of its own parts.
#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "core/arm/arm_solver.h"
#include "tests/support/arms.h"
#include "tests/support/kdl_arm.h"

#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

class BesideKdl : public ::testing::TestWithParam<const char*> {
protected:
    ArmModel arm_ = test::with_tool(test::arm(GetParam()), 60.0);
    test::KdlArm kdl_{arm_};
    std::mt19937 random_{2};
};

TEST_P(BesideKdl, GoesWhereKdlGoes) {
    for (int n = 0; n < 2000; ++n) {
        const JointPositions q = test::random_joints(random_, arm_);
        EXPECT_LT((base_T_tool(arm_, q).matrix() - kdl_.forward(q).matrix()).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((arm_jacobian(arm_, q) - kdl_.jacobian(q)).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST_P(BesideKdl, FindsWhatKdlFinds) {
    int found = 0;
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = test::random_joints(random_, arm_, 0.7);
        const Frame goal = base_T_tool(arm_, q);
        const JointPositions start = test::random_joints(random_, arm_, 0.7);
        const auto theirs = kdl_.inverse(goal, start);
        if (!theirs) {
            continue;
        }
        ++found;
        const Frame back = base_T_tool(arm_, *theirs);
        EXPECT_LT((back.translation() - goal.translation()).norm(), 1e-3);
        if (arm_.planar_elbow()) { // whatever KDL finds is one of our branches, in some turn
            ArmDescription unlimited = arm_.description();
            for (ArmJoint& joint : unlimited.joints) {
                joint.min = -10.0 * pi;
                joint.max = 10.0 * pi;
            }
            const auto ours = arm_inverse(ArmModel(unlimited), goal, q).branches;
            EXPECT_TRUE(std::ranges::any_of(ours, [&](const JointPositions& branch) {
                return std::ranges::equal(branch, *theirs, [](double a, double b) {
                    return std::abs(std::remainder(a - b, 2.0 * pi)) < 1e-4;
                });
            })) << theirs->transpose();
        }
    }
    EXPECT_GT(found, 20);
}

/// A goal that five joints cannot have, turned into the plane of the arm: KDL goes there with our joints.
TEST(BesideKdlK4, ReachesWhatWasProjected) {
    const ArmModel arm = test::arm("motoman-l3");
    test::KdlArm kdl(arm);
    std::mt19937 random(4);
    int reached = 0;
    for (int n = 0; n < 500; ++n) {
        Frame goal = base_T_tool(arm, test::random_joints(random, arm, 0.6));
        std::normal_distribution<double> any;
        const Eigen::Quaterniond turn(any(random), any(random), any(random), any(random));
        goal.linear() = turn.normalized().toRotationMatrix();
        const auto projected = projected_goal(goal);
        ASSERT_TRUE(projected);
        for (const JointPositions& branch : arm_inverse(arm, *projected, JointPositions::Zero(5)).branches) {
            ++reached;
            EXPECT_LT((kdl.forward(branch).matrix() - projected->matrix()).cwiseAbs().maxCoeff(), 1e-9);
        }
    }
    EXPECT_GT(reached, 500);
}

/// A table with all of its numbers different from 0, in both conventions, as KDL reads them.
TEST(BesideKdlTables, ReadsClassicalAndModifiedTables) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int table = 0; table < 100; ++table) {
        ArmDescription rows;
        rows.name = "table";
        for (int n = 0; n < 6; ++n) {
            ArmJoint joint;
            joint.name = std::to_string(n + 1);
            joint.kind = table % 6 == n ? JointKind::prismatic : JointKind::revolute;
            joint.alpha = 3.0 * number(random);
            joint.a = 300.0 * number(random);
            joint.d = 300.0 * number(random);
            joint.theta = 3.0 * number(random);
            joint.min = -pi;
            joint.max = pi;
            rows.joints.push_back(joint);
        }
        const ArmModel modified(rows), classical(from_classical(rows));
        const JointPositions q = test::random_joints(random, modified);
        KDL::Frame craig = KDL::Frame::Identity(), distal = KDL::Frame::Identity();
        for (int n = 0; n < 6; ++n) {
            const ArmJoint& row = rows.joints[static_cast<std::size_t>(n)];
            const bool turns = row.kind == JointKind::revolute;
            const double d = row.d + (turns ? 0.0 : q[n]), theta = row.theta + (turns ? q[n] : 0.0);
            craig = craig * KDL::Frame::DH_Craig1989(row.a, row.alpha, d, theta);
            distal = distal * KDL::Frame::DH(row.a, row.alpha, d, theta);
        }
        for (const auto& [arm, theirs] : {std::pair(&modified, &craig), std::pair(&classical, &distal)}) {
            const Frame ours = base_T_tool(*arm, q);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(ours.translation()[i], theirs->p(i), 1e-9);
                for (int j = 0; j < 3; ++j) {
                    EXPECT_NEAR(ours.linear()(i, j), theirs->M(i, j), 1e-12);
                }
            }
            test::KdlArm kdl(*arm);
            EXPECT_LT((arm_jacobian(*arm, q) - kdl.jacobian(q)).cwiseAbs().maxCoeff(), 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, BesideKdl, ::testing::Values("motoman-l3", "six-axis", "scara"));

} // namespace
} // namespace millwright::arm
