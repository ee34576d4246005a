#include "core/arm/arm_shell.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

TEST(ReachShell, HoldsEveryWristThatJointsCanMake) {
    const ArmModel arm = test::arm("motoman-l3");
    std::mt19937 random(11);
    for (int n = 0; n < 5000; ++n) {
        JointPositions q = test::random_joints(random, arm);
        q[0] = 0.0;
        const Vec3 wrist = base_T_joints(arm, q)[3].translation();
        EXPECT_TRUE(wrist_reaches(arm, {wrist.x(), wrist.z()})) << q.transpose();
    }
}

// Places of a fine raster are reached if and only if some of very many random joints come near them.
TEST(ReachShell, LeavesOutWhatNoJointsMake) {
    const ArmModel arm = test::arm("motoman-l3");
    EXPECT_FALSE(wrist_reaches(arm, {1451.0, 0.0}));
    EXPECT_FALSE(wrist_reaches(arm, {149.0, 0.0}));
    std::mt19937 random(12);
    std::vector<Vec2> made;
    for (int n = 0; n < 40000; ++n) {
        JointPositions q = test::random_joints(random, arm);
        q[0] = 0.0;
        const Vec3 wrist = base_T_joints(arm, q)[3].translation();
        made.emplace_back(wrist.x(), wrist.z());
    }
    std::uniform_real_distribution<double> anywhere(-1500.0, 1500.0);
    int unreached = 0;
    for (int n = 0; n < 300; ++n) {
        const Vec2 place(anywhere(random), anywhere(random));
        const bool near = std::ranges::any_of(made, [&](const Vec2& w) { return (w - place).norm() < 3.0; });
        if (near) {
            // at most the 3 mm outside of the border
            const bool reached =
                wrist_reaches(arm, place) || wrist_reaches(arm, place * (1.0 - 3.0 / place.norm())) ||
                wrist_reaches(arm, place * (1.0 + 3.0 / place.norm())) ||
                wrist_reaches(arm, place + Vec2(0.0, 3.0)) || wrist_reaches(arm, place - Vec2(0.0, 3.0));
            EXPECT_TRUE(reached) << place.transpose();
        }
        unreached += wrist_reaches(arm, place) ? 0 : 1;
    }
    EXPECT_GT(unreached, 30);
}

TEST(ReachShell, ItsBorderIsBetweenReachedAndNotReached) {
    const ArmModel arm = test::arm("motoman-l3");
    const ReachShell shell = reach_shell(arm);
    ASSERT_FALSE(shell.border.empty());
    double farthest = 0.0;
    for (const auto& curve : shell.border) {
        ASSERT_GT(curve.size(), 1U);
        for (std::size_t n = 0; n < curve.size(); ++n) {
            const Vec2& place = curve[n];
            farthest = std::max(farthest, place.norm());
            const bool at_end =
                n == 0 || n + 1 == curve.size(); // where it may go on for a step into the inside
            const double around = at_end ? 60.0 : 8.0;
            bool reached = false, left_out = false;
            for (int turn = 0; turn < 16; ++turn) {
                const double angle = 2.0 * pi * turn / 16;
                const bool there =
                    wrist_reaches(arm, place + around * Vec2(std::cos(angle), std::sin(angle)));
                (there ? reached : left_out) = true;
            }
            EXPECT_TRUE(reached && left_out) << place.transpose();
        }
    }
    EXPECT_NEAR(farthest, 1450.0, 1e-9);
    EXPECT_NEAR(shell.last - shell.first, from_degrees(350.0), 1e-12);
}

TEST(ReachShell, IsForArmsOfThatKind) {
    EXPECT_THROW((void)reach_shell(test::arm("scara")), Defect);
}

struct Extent {
    Vec2 low = Vec2::Constant(1e9), high = Vec2::Constant(-1e9);
};

Extent extent_of(const ReachShell& shell) {
    Extent extent;
    for (const auto& border : shell.border) {
        for (const Vec2& point : border) {
            extent.low = extent.low.cwiseMin(point);
            extent.high = extent.high.cwiseMax(point);
        }
    }
    return extent;
}

TEST(SampledShell, OfAScaraIsItsRing) {
    const ArmModel arm = test::arm("scara");
    const auto shell = sampled_shell(arm);
    ASSERT_TRUE(shell.has_value());
    ASSERT_EQ(shell->border.size(), 1U);
    const double folded = 145.0 * pi / 180.0;
    const double nearest = std::sqrt(325.0 * 325.0 + 275.0 * 275.0 + 2.0 * 325.0 * 275.0 * std::cos(folded));
    const Extent extent = extent_of(*shell);
    EXPECT_NEAR(extent.low.x(), nearest, 6.0);
    EXPECT_NEAR(extent.high.x(), 600.0, 6.0);
    EXPECT_NEAR(extent.low.y(), 150.0, 6.0);
    EXPECT_NEAR(extent.high.y(), 350.0, 6.0);
    EXPECT_DOUBLE_EQ(shell->first, arm.joint(0).min);
    EXPECT_DOUBLE_EQ(shell->last, arm.joint(0).max);
    EXPECT_EQ(shell->border.front().front(), shell->border.front().back()); // closed
}

TEST(SampledShell, OfAnArmWithAClosedFormIsThatOneNearly) {
    const ArmModel arm = test::arm("motoman-l3");
    const auto sampled = sampled_shell(arm);
    ASSERT_TRUE(sampled.has_value());
    const Extent one = extent_of(*sampled), other = extent_of(reach_shell(arm));
    EXPECT_LT((one.low - other.low).cwiseAbs().maxCoeff(), 30.0);
    EXPECT_LT((one.high - other.high).cwiseAbs().maxCoeff(), 30.0);
    int near = 0, all = 0;
    for (const auto& border : sampled->border) {
        for (const Vec2& point : border) {
            const auto reached = [&](double x, double y) { return wrist_reaches(arm, point + Vec2(x, y)); };
            const bool in =
                reached(30.0, 0.0) || reached(-30.0, 0.0) || reached(0.0, 30.0) || reached(0.0, -30.0);
            const bool out =
                !(reached(30.0, 0.0) && reached(-30.0, 0.0) && reached(0.0, 30.0) && reached(0.0, -30.0));
            near += in && out ? 1 : 0;
            ++all;
        }
    }
    EXPECT_GT(near, 0.98 * all); // the true border is within 30 of 3,000 mm
}

TEST(SampledShell, HoldsTheWristOfAnArmWithSixAxes) {
    const ArmModel arm = test::arm("six-axis");
    const auto shell = sampled_shell(arm);
    ASSERT_TRUE(shell.has_value());
    const Extent extent = extent_of(*shell);
    std::mt19937 random(5);
    for (int n = 0; n < 2000; ++n) {
        JointPositions q = test::random_joints(random, arm);
        q[0] = 0.0;
        const Vec3 wrist = base_T_joints(arm, q).back().translation();
        const double slack = 0.02 * (extent.high - extent.low).maxCoeff();
        EXPECT_GT(wrist.z(), extent.low.y() - slack);
        EXPECT_LT(wrist.z(), extent.high.y() + slack);
        EXPECT_LT(std::hypot(wrist.x(), wrist.y()), std::max(extent.high.x(), -extent.low.x()) + slack);
    }
}

} // namespace
} // namespace millwright::arm
