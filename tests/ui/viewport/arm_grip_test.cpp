#include "ui/viewport/arm_grip.h"

#include "core/arm/arm_forward.h"
#include "core/base/units.h"
#include "tests/support/arms.h"
#include "ui/render/camera.h"
#include "ui/render/convert.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace millwright::viewport {
namespace {

class ArmGripTest : public ::testing::Test {
protected:
    ArmScene scene_;
    render::View view_;

    ArmGripTest() {
        scene_.look = read_arm_look("assets/arms/motoman-l3.json");
        scene_.joints = test::degrees({20, -80, 70, 10, 0});
        const render::CameraPose pose{{400.0, 100.0, 0.0}, 4500.0};
        view_ =
            render::Camera(pose).view({1000, 800}, {.min = glm::dvec3(-2000.0), .max = glm::dvec3(2000.0)});
    }

    glm::dvec2 pixel(const Vec3& point) const { return render::project(view_, render::to_glm(point))->pixel; }
    Vec3 on_link(int joint, const Vec3& local) const {
        return arm::base_T_joints(scene_.look->arm(), scene_.joints)[static_cast<std::size_t>(joint)] * local;
    }
};

TEST_F(ArmGripTest, TakesTheTipWhereItIsAndElseTheLinkUnderTheMouse) {
    const Vec3 tip = arm::base_T_tool(scene_.look->arm(), scene_.joints).translation();
    const auto at_tip = pick_arm(scene_, view_, pixel(tip), 10.0);
    ASSERT_TRUE(at_tip);
    EXPECT_TRUE(at_tip->is_tip());
    const auto forearm = pick_arm(scene_, view_, pixel(on_link(2, Vec3(400.0, 0.0, 0.0))), 10.0);
    ASSERT_TRUE(forearm);
    EXPECT_EQ(forearm->joint, 2);
    const auto upper = pick_arm(scene_, view_, pixel(on_link(1, Vec3(400.0, 0.0, 0.0))), 10.0);
    ASSERT_TRUE(upper);
    EXPECT_EQ(upper->joint, 1);
}

TEST_F(ArmGripTest, TakesNothingBesideTheArmNorWhatDoesNotMove) {
    EXPECT_FALSE(pick_arm(scene_, view_, {5.0, 5.0}, 10.0));
    EXPECT_FALSE(pick_arm(scene_, view_, pixel(Vec3(230.0, -230.0, -880.0)), 10.0)); // the foot
}

TEST_F(ArmGripTest, AJointTurnsUntilWhatIsHeldIsUnderTheMouse) {
    const Vec3 local(400.0, 0.0, 0.0);
    ArmScene there = scene_;
    there.joints[1] += from_degrees(25.0);
    const Vec3 target = arm::base_T_joints(scene_.look->arm(), there.joints)[1] * local;
    EXPECT_NEAR(joint_towards(scene_, 1, local, view_, pixel(target)), there.joints[1], 1e-4);
}

TEST_F(ArmGripTest, AJointStaysWithinItsLimits) {
    const double most = scene_.look->arm().joint(0).max;
    for (const double x : {-5000.0, 0.0, 1000.0, 6000.0}) {
        const double position = joint_towards(scene_, 0, Vec3(300.0, 0.0, 0.0), view_, {x, 300.0});
        EXPECT_LE(std::abs(position), most + 1e-12);
    }
}

TEST(ArmScene, TellsWhatIsNearALimit) {
    const arm::ArmModel arm = test::arm("motoman-l3");
    EXPECT_TRUE(near_limit(arm.joint(0), from_degrees(170.0)));
    EXPECT_FALSE(near_limit(arm.joint(0), from_degrees(0.0)));
    EXPECT_DOUBLE_EQ(share_of_range(arm.joint(0), 0.0), 0.5);
}

} // namespace
} // namespace millwright::viewport
