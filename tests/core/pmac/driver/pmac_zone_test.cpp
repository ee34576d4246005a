// The arm's zone by the driver at the emulated card, in computed time.
#include "core/arm/arm_zone.h"
#include "tests/core/pmac/driver/pmac_wire.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::PmacWire;
using testing::HasSubstr;

/// Stretched from its zero, the arm's tip is at z = -1450 sin(joint 2).
std::shared_ptr<const arm::ArmModel> above(double least_z) {
    arm::ArmDescription description = test::arm("motoman-l3").description();
    arm::ArmZone zone;
    zone.least.z() = least_z;
    description.zone = std::make_shared<const arm::ArmZone>(zone);
    return std::make_shared<const arm::ArmModel>(std::move(description));
}

double tip_z(const PmacWire& wire) {
    return -650.0 * std::sin(from_degrees(wire.degrees(1))) -
           800.0 * std::sin(from_degrees(wire.degrees(1) + wire.degrees(2)));
}

TEST(PmacZone, AProgramIsStoppedAtItsBorder) {
    PmacWire wire({}, true, "XYZA", {}, {}, above(-400.0));
    wire.session.start({"LINEAR", "ABS", "TA200", "TS50", "F10", "Y60"}, wire.now);
    ASSERT_TRUE(wire.run_to_end(30.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_THAT(wire.session.status().message, HasSubstr("below -400 of the arm's workspace"));
    EXPECT_LT(tip_z(wire), -400.0);
    EXPECT_GT(tip_z(wire), -540.0); // it brakes from 250 mm/s in the card's second (I195)
    wire.pass(1.0);
    wire.session.jog(jog_of(1, -10.0, 5.0), wire.now); // the way back is free
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_GT(tip_z(wire), -400.0);
}

TEST(PmacZone, ATypedGoalOutsideIsNotSent) {
    PmacWire wire({}, true, "XYZA", {}, {}, above(-400.0));
    try {
        (void)wire.session.command({"#3J=9000"}, false); // 60 degrees: the forearm alone
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("below -400"));
    }
}

TEST(PmacZone, ATypedProgramIsStoppedAtItsBorder) {
    PmacWire wire({}, true, "XYZA", {}, {}, above(-400.0));
    (void)wire.session.command({"OPEN PROG 5", "CLEAR", "LINEAR ABS TA200 TS50 F5 Z60", "CLOSE", "&1B5R"},
                               true);
    ASSERT_TRUE(wire.run_to_end(60.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_THAT(wire.session.status().message, HasSubstr("arm's workspace"));
    EXPECT_NEAR(tip_z(wire), -400.0, 15.0);
}

TEST(PmacZone, AHeldJogEndsAtItsBorder) {
    PmacWire wire({}, true, "XYZA", {}, {}, above(-400.0));
    std::string why;
    for (int n = 0; n < 3000 && why.empty(); ++n) {
        try {
            wire.session.jog(jog_of(1, 25.0, 25.0, 0.1), wire.now);
            wire.pass(0.016);
        } catch (const Error& error) {
            why = error.what();
        }
    }
    EXPECT_THAT(why, HasSubstr("below -400"));
    ASSERT_TRUE(wire.run_to_end(2.0));
    EXPECT_NEAR(tip_z(wire), -400.0, 5.0); // 0.2 degrees
    EXPECT_NE(wire.state(), drivers::DriverState::alarm) << wire.session.status().message;
}

TEST(PmacZone, NoJogEndsOutside) {
    PmacWire wire({}, true, "XYZA", {}, {}, above(-400.0));
    try {
        wire.session.jog(jog_of(1, 20.0, 5.0), wire.now);
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("below -400"));
    }
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    wire.session.jog(jog_of(1, 15.0, 5.0), wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_NEAR(wire.degrees(1), 15.0, 0.5);
    drivers::Jog both = jog_of(1, 4.0, 5.0); // down with the shoulder, up with the elbow
    both.way[2] = from_degrees(-10.0);
    wire.pass(0.5);
    wire.session.jog(both, wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
}

} // namespace
} // namespace millwright::pmac::internal
