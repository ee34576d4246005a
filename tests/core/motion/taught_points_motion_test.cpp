#include "core/arm/arm_file.h"
#include "core/arm/arm_forward.h"
#include "core/arm/arm_simulation.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::motion {
namespace {

using arm::ArmModel;
using arm::JointPositions;

ArmModel l3() {
    return arm::read_arm("assets/arms/motoman-l3.json").arm;
}

JointPositions joints_from_degrees(double a, double b, double c, double d, double e) {
    JointPositions joints(5);
    joints << from_degrees(a), from_degrees(b), from_degrees(c), from_degrees(d), from_degrees(e);
    return joints;
}

const JointPositions home = arm::arm_home();

JointPositions beside_home(double turn_deg) {
    JointPositions joints = home;
    joints[0] += from_degrees(turn_deg);
    return joints;
}

void add(std::vector<ArmStop>& stops,
         const char* name,
         const JointPositions& joints,
         bool straight,
         double share) {
    stops.emplace_back();
    stops.back().name = name;
    stops.back().joints = joints;
    stops.back().straight = straight;
    stops.back().share = share;
}

std::vector<ArmStop> to(const char* name, const JointPositions& joints, bool straight, double share) {
    std::vector<ArmStop> stops;
    add(stops, name, joints, straight, share);
    return stops;
}

TEST(ArmTourC6, EndsAtTheLastOfItsPointsAndPassesTheOthers) {
    const ArmModel arm = l3();
    std::vector<ArmStop> stops = to("A", beside_home(20), false, 1.0);
    add(stops, "B", beside_home(-20), false, 0.5);
    add(stops, "C", beside_home(10), true, 0.4);
    const program::Program program = motion_through(arm, home, stops);
    const Trajectory motion = plan(program, arm, {}, {});
    EXPECT_LT((motion.at(motion.duration()).position - stops[2].joints).norm(), 1e-6);
    double nearest = 1.0;
    for (double t = 0.0; t < motion.duration(); t += 0.001) {
        nearest = std::min(nearest, (motion.at(t).position - stops[1].joints).norm());
    }
    EXPECT_LT(nearest, from_degrees(0.1));
}

TEST(ArmTourC6, AShareOfTheSpeedIsKept) {
    const ArmModel arm = l3();
    const Trajectory motion =
        plan(motion_through(arm, home, to("A", beside_home(60), false, 0.25)), arm, {}, {});
    double fastest = 0.0;
    for (double t = 0.0; t < motion.duration(); t += 0.001) {
        fastest = std::max(fastest, std::abs(motion.at(t).velocity[0]));
    }
    EXPECT_NEAR(fastest, 0.25 * arm.joint(0).max_velocity, 1e-3 * arm.joint(0).max_velocity);
}

TEST(ArmTourC6, TheTipOfAStraightMoveStaysOnItsLine) {
    const ArmModel arm = l3();
    const JointPositions end = beside_home(30);
    const Trajectory motion = plan(motion_through(arm, home, to("A", end, true, 1.0)), arm, {}, {});
    const Vec3 from = arm::base_T_tool(arm, home).translation();
    const Vec3 to = arm::base_T_tool(arm, end).translation();
    double farthest = 0.0, fastest = 0.0;
    Vec3 last = from;
    for (double t = 0.0; t < motion.duration(); t += 0.002) {
        const Vec3 tip = arm::base_T_tool(arm, motion.at(t).position).translation();
        farthest = std::max(farthest, (tip - from).cross((to - from).normalized()).norm());
        fastest = std::max(fastest, (tip - last).norm() / 0.002);
        last = tip;
    }
    EXPECT_LT(farthest, 0.05);
    EXPECT_LT(fastest, 1.01 * taught_motion_speed);
}

std::string refusal(const std::vector<ArmStop>& stops) {
    const ArmModel arm = l3();
    try {
        (void)motion_through(arm, home, stops);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ArmTourC6, NamesThePointThatItCannotGoTo) {
    EXPECT_THAT(refusal(to("Drill", beside_home(179), false, 1.0)), testing::HasSubstr("'Drill' cannot be"));
    EXPECT_THAT(refusal(to("Scara", JointPositions::Zero(4), false, 1.0)), testing::HasSubstr("4 joints"));
    // a line to the other side leads through the base
    std::vector<ArmStop> stops = to("Back", joints_from_degrees(140, -90, 90, 0, 0), false, 1.0);
    add(stops, "Front", joints_from_degrees(-40, -90, 90, 0, 0), true, 1.0);
    EXPECT_THAT(refusal(stops), testing::HasSubstr("'Front' cannot be"));
}

} // namespace
} // namespace millwright::motion
