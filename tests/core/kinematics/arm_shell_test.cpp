#include "core/kinematics/arm_shell.h"

#include "core/base/error.h"
#include "core/kinematics/arm_forward.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

namespace millwright::kinematics {
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

} // namespace
} // namespace millwright::kinematics
