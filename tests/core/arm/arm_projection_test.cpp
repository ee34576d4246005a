// The projection of a general goal into the plane of an arm of five joints, equations (1) to (6) of
// Saengsasri, Nittayachin 1996, KMITL, section 1.4: corrected they are what this program does; as printed
// they are wrong.
#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::arm {
namespace {

enum class Sine { with_sign, from_the_cosine };

/// Equations (2) to (6) for the normal M of equation (1).
Mat3 projected_by_equations(const Mat3& goal, const Vec3& m, Sine sine) {
    const Vec3 y = goal.col(1), z = goal.col(2);
    const Vec3 k = m.cross(z).normalized();
    const Vec3 z_new = k.cross(m);
    const double c = z.dot(z_new);
    const double s = sine == Sine::with_sign ? m.dot(z) : std::sqrt(std::max(0.0, 1.0 - c * c));
    const Vec3 y_new = c * y + s * k.cross(y) + (1.0 - c) * k.dot(y) * k;
    Mat3 projected;
    projected << y_new.cross(z_new), y_new, z_new;
    return projected;
}

Vec3 normal_of_the_plane(const Vec3& tip) {
    return Vec3(-tip.y(), tip.x(), 0.0).normalized();
}

/// As printed.
Vec3 printed_normal(const Vec3& tip) {
    return Vec3(-tip.x(), tip.y(), 0.0).normalized();
}

class ArmProjectionK4 : public ::testing::Test {
protected:
    /// A tip that the arm reaches, and any directions of the tool.
    [[nodiscard]] Frame general_goal() {
        Frame goal = base_T_tool(arm_, test::random_joints(random_, arm_, 0.6));
        std::normal_distribution<double> any;
        const Eigen::Quaterniond turn(any(random_), any(random_), any(random_), any(random_));
        goal.linear() = turn.normalized().toRotationMatrix();
        return goal;
    }

    ArmModel arm_ = test::arm("motoman-l3");
    std::mt19937 random_{1996};
};

TEST_F(ArmProjectionK4, IsThatOfTheCorrectedEquations) {
    int reached = 0;
    for (int n = 0; n < 5000; ++n) {
        const Frame goal = general_goal();
        const Vec3 m = normal_of_the_plane(goal.translation());
        const auto ours = projected_goal(goal);
        ASSERT_TRUE(ours);
        const Mat3 theirs = projected_by_equations(goal.linear(), m, Sine::with_sign);
        EXPECT_LT((ours->linear() - theirs).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_NEAR(m.dot(ours->linear().col(2)), 0.0, 1e-12);
        for (const JointPositions& branch : arm_inverse(arm_, *ours, JointPositions::Zero(5)).branches) {
            ++reached;
            EXPECT_LT((base_T_tool(arm_, branch).matrix() - ours->matrix()).cwiseAbs().maxCoeff(), 1e-9);
        }
    }
    EXPECT_GT(reached, 5000);
}

TEST_F(ArmProjectionK4, GivesTheFifthJointFromAllOfTheMatrix) {
    int front = 0;
    for (int n = 0; n < 1000; ++n) {
        const JointPositions q = test::random_joints(random_, arm_, 0.4);
        const Frame goal = base_T_tool(arm_, q);
        const Mat3 r = goal.linear();
        const double c1 = std::cos(q[0]), s1 = std::sin(q[0]);
        if (c1 * goal.translation().x() + s1 * goal.translation().y() < 1.0) {
            continue; // over its back: the formula is for the base that looks at the tip
        }
        ++front;
        const double roll = std::atan2(c1 * r(1, 0) - s1 * r(0, 0), c1 * r(1, 1) - s1 * r(0, 1));
        EXPECT_NEAR(std::remainder(roll - q[4], 2.0 * pi), 0.0, 1e-9);
        const auto branches = arm_inverse(arm_, goal, q).branches;
        EXPECT_TRUE(std::ranges::any_of(branches, [&](const JointPositions& branch) {
            return (branch - q).cwiseAbs().maxCoeff() < 1e-6;
        })) << q.transpose();
    }
    EXPECT_GT(front, 500);
}

TEST_F(ArmProjectionK4, TheNormalAsPrintedIsNotAcrossThePlane) {
    int refused = 0;
    constexpr int goals = 1000;
    for (int n = 0; n < goals; ++n) {
        Frame goal = general_goal();
        const Vec3 tip = goal.translation();
        goal.linear() = projected_by_equations(goal.linear(), printed_normal(tip), Sine::with_sign);
        const bool in_plane = std::abs(normal_of_the_plane(tip).dot(goal.linear().col(2))) < 1e-6;
        const auto found = arm_inverse(arm_, goal, JointPositions::Zero(5));
        EXPECT_EQ(found.branches.empty() && !in_plane, !in_plane);
        refused += in_plane ? 0 : 1;
    }
    EXPECT_GT(refused, goals * 9 / 10);
}

TEST_F(ArmProjectionK4, TheSineWithoutItsSignTurnsHalfOfTheGoalsTheWrongWay) {
    int wrong = 0;
    double worst = 0.0;
    constexpr int goals = 2000;
    for (int n = 0; n < goals; ++n) {
        const Frame goal = general_goal();
        const Vec3 m = normal_of_the_plane(goal.translation());
        const Mat3 right = projected_by_equations(goal.linear(), m, Sine::with_sign);
        const Mat3 printed = projected_by_equations(goal.linear(), m, Sine::from_the_cosine);
        const double off = (right - printed).cwiseAbs().maxCoeff();
        wrong += off > 1e-6 ? 1 : 0;
        worst = std::max(worst, off);
    }
    EXPECT_NEAR(static_cast<double>(wrong) / goals, 0.5, 0.05);
    EXPECT_GT(worst, 1.5);
}

} // namespace
} // namespace millwright::arm
