#include "core/motion/arm_motion.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/motion/planner.h"
#include "tests/support/arm_ways.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::motion {
namespace {

using arm::ArmModel;
using arm::ArmPath;
using arm::ArmWay;
using arm::JointPositions;
using ::testing::HasSubstr;

const Vec3 down = -Vec3::UnitZ();

ArmModel arm() {
    return test::arm("motoman-l3");
}

JointPositions joints_in_degrees(double a, double b, double c, double d, double e) {
    JointPositions q(5);
    q << a, b, c, d, e;
    return q * (pi / 180.0);
}

TEST(ArmMotion, AJointMoveTakesWhatItsSlowestJointNeeds) {
    const ArmModel model = arm();
    ArmMotion motion(model, joints_in_degrees(0, -90, 90, 0, 0));
    motion.go_to(joints_in_degrees(45, -80, 90, 0, 0));
    const Trajectory trajectory = plan(motion.program(), model, {}, {});
    const double velocity = 90.0, acceleration = 300.0; // of joint 1, deg/s and deg/s^2
    EXPECT_NEAR(trajectory.duration(), 45.0 / velocity + velocity / acceleration, 1e-9);
    EXPECT_NEAR(trajectory.at(trajectory.duration()).position[0], from_degrees(45.0), 1e-12);
}

TEST(ArmMotion, ALineIsFollowedAtItsFeedWithinItsTolerance) {
    const ArmModel model = arm();
    const Vec3 a(800.0, -200.0, 100.0), b(800.0, 200.0, 100.0);
    const std::vector<ArmWay> ways{test::line_way(a, b, down, 20.0)};
    const ArmPath path = arm::follow_path_well(model, ways, joints_in_degrees(0, -90, 90, 0, 0), {}, {});
    ArmMotion motion(model, path.points.front().joints);
    motion.follow(ways, path, "part.ngc");
    PlannerSettings settings;
    settings.rounding_tolerance = 0.01;
    const Trajectory trajectory = plan(motion.program(), model, settings, {});
    // 400 mm at 20 mm/s, and what starting and stopping cost: at most a second.
    EXPECT_GE(trajectory.duration(), 20.0);
    EXPECT_LE(trajectory.duration(), 21.0);
    for (double time = 0.0; time < trajectory.duration(); time += 0.05) {
        const Sample now = trajectory.at(time);
        const Vec3 tip = arm::base_T_tool(model, now.position).translation();
        EXPECT_LE(std::hypot(tip.x() - 800.0, tip.z() - 100.0), 0.021) << time;
        const double speed = (arm::arm_jacobian(model, now.position).topRows<3>() * now.velocity).norm();
        EXPECT_LE(speed, 20.0 * 1.01) << time;
    }
}

TEST(ArmMotion, NoJointIsFasterThanItCanWhereThePathIsNearlySingular) {
    const ArmModel model = arm();
    const std::vector<ArmWay> ways{
        test::line_way(Vec3(2.0, -300.0, 700.0), Vec3(2.0, 300.0, 700.0), Vec3::UnitZ(), 200.0)};
    const ArmPath path = arm::follow_path_well(model, ways, joints_in_degrees(0, -90, 90, 0, 0), {}, {});
    ASSERT_TRUE(path.whole());
    ArmMotion motion(model, path.points.front().joints);
    motion.follow(ways, path, "part.ngc");
    const Trajectory trajectory = plan(motion.program(), model, {}, {});
    EXPECT_GE(trajectory.duration(),
              179.0 / 90.0); // half a turn of joint 1, which the feed would not allow for
    for (double time = 0.0; time < trajectory.duration(); time += 0.002) {
        const Sample now = trajectory.at(time);
        for (int n = 0; n < 5; ++n) {
            EXPECT_LE(std::abs(now.velocity[n]), model.joint(n).max_velocity * (1.0 + 1e-9));
            EXPECT_LE(std::abs(now.acceleration[n]), model.joint(n).max_acceleration * (1.0 + 1e-9));
        }
    }
}

TEST(ArmMotion, RefusesWhatTheArmCannotFollowWithItsLine) {
    std::vector<ArmWay> ways{test::line_way(Vec3(1400.0, 0.0, 0.0), Vec3(1500.0, 0.0, 0.0), down)};
    ways.front().line = 17;
    const JointPositions rest = joints_in_degrees(0, -90, 90, 0, 0);
    const ArmPath path = arm::follow_path_well(arm(), ways, rest, {}, {});
    const ArmModel model = arm();
    ArmMotion motion(model, rest);
    try {
        motion.follow(ways, path, "part.ngc");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("part.ngc:17: the wrist would be"));
    }
    EXPECT_TRUE(motion.program().blocks.empty());
}

TEST(ArmMotion, RefusesJointsBeyondTheirLimits) {
    const ArmModel model = arm();
    ArmMotion motion(model, joints_in_degrees(0, -90, 90, 0, 0));
    try {
        motion.go_to(joints_in_degrees(0, 70, 90, 0, 0));
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(
            to_text(error.diagnostic()),
            HasSubstr("joint 2 would have to move to 70.000 deg, but its limits are -200.000 and 60.000"));
    }
}

TEST(ArmMotion, SlidingJointsArePlannedInMillimetres) {
    const ArmModel scara = test::arm("scara");
    JointPositions start = JointPositions::Zero(scara.joint_count());
    int slide = 0;
    while (scara.joint(slide).kind != arm::JointKind::prismatic) {
        ++slide;
    }
    start[slide] = scara.joint(slide).min;
    JointPositions end = start;
    end[slide] = scara.joint(slide).max;
    ArmMotion motion(scara, start);
    motion.go_to(end);
    const double way = scara.joint(slide).max - scara.joint(slide).min;
    const double v = scara.joint(slide).max_velocity, a = scara.joint(slide).max_acceleration;
    const double time = way > v * v / a ? way / v + v / a : 2.0 * std::sqrt(way / a);
    EXPECT_NEAR(plan(motion.program(), scara, {}, {}).duration(), time, 1e-9);
}

} // namespace
} // namespace millwright::motion
