#include "core/arm/arm_forward.h"
#include "core/arm/arm_hold.h"
#include "core/base/error.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

using ::testing::HasSubstr;

const JointPositions somewhere = test::degrees({25, -70, 60, 30, 15});

// The Jacobian is the judge: it shares nothing with the inverse.
TEST(ArmRates, MoveTheTipAsTheJacobianSays) {
    for (const char* name : {"motoman-l3", "six-axis"}) {
        const ArmModel arm = test::arm(name);
        const JointPositions joints =
            arm.joint_count() == 5 ? somewhere : test::degrees({20, -50, 60, 20, 50, 10});
        for (const Vec3& velocity : {Vec3(30, 0, 0), Vec3(0, -20, 0), Vec3(0, 0, 40), Vec3(10, 20, -15)}) {
            const ArmRates found = tip_rates(arm, joints, velocity);
            ASSERT_TRUE(found.rates) << name << found.why;
            const Vec3 made = (arm_jacobian(arm, joints) * *found.rates).head<3>();
            EXPECT_LT((made - velocity).norm(), 0.01 * velocity.norm()) << name << velocity.transpose();
        }
    }
}

TEST(ArmRates, KeepTheToolsLeanInThePlaneOfTheArm) {
    const ArmModel arm = test::arm("motoman-l3");
    const ArmRates found = tip_rates(arm, somewhere, Vec3(0.0, 50.0, 20.0));
    ASSERT_TRUE(found.rates);
    EXPECT_NEAR((*found.rates)[1] + (*found.rates)[2] + (*found.rates)[3], 0.0, 1e-9);
    EXPECT_NEAR((*found.rates)[4], 0.0, 1e-9);
}

TEST(ArmRates, SayWhyTheArmCannot) {
    const ArmModel arm = test::arm("motoman-l3");
    const JointPositions stretched = test::degrees({0, -30, 0, 0, 0});
    EXPECT_THAT(tip_rates(arm, stretched, base_T_tool(arm, stretched).translation()).why,
                HasSubstr("291.924"));
    EXPECT_THAT(tip_rates(arm, test::degrees({0, -30, 0.001, 0, 0}), Vec3(-1.0, 0.0, -0.6)).why,
                HasSubstr("singular"));
    EXPECT_THROW((void)tip_rates(arm, somewhere, Vec3::Zero()), Defect);
}

} // namespace
} // namespace millwright::arm
