// F2: what becomes of motion and power when a person leaves, in computed time.
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::PmacWire;

TEST(PmacPartingF2, MotionEndsAndThePowerIsTakenAndSeenToBeGone) {
    PmacWire wire;
    wire.session.jog(jog_of(0, 40.0, 5.0), wire.now);
    wire.pass(1.0);
    ASSERT_FALSE(wire.standing());
    const double before = wire.degrees(0);
    wire.leave();
    EXPECT_FALSE(wire.powered());
    EXPECT_TRUE(wire.standing());
    EXPECT_EQ(wire.session.farewell(), "");
    EXPECT_LT(wire.degrees(0) - before, 1.0); // braked, and did not coast
}

TEST(PmacPartingF2, AProgramAndATypedLineEndLikewise) {
    for (const bool program : {true, false}) {
        PmacWire wire;
        if (program) {
            wire.session.start({"ABS LINEAR TM5000", "X60"}, wire.now);
        } else {
            (void)wire.session.command({"#1J=6000"}, false);
        }
        ASSERT_TRUE(wire.run_until([&] { return wire.degrees(0) > 2.0; }, 10.0));
        wire.leave();
        EXPECT_FALSE(wire.powered());
        EXPECT_TRUE(wire.standing());
        EXPECT_FALSE(wire.card.program_runs(1));
        EXPECT_EQ(wire.session.farewell(), "");
    }
}

TEST(PmacPartingF2, PowerThatIsJustOnItsWayIsTakenToo) {
    PmacWire wire({}, false);
    wire.session.enable(wire.now);
    wire.leave();
    wire.card.advance(1.0);
    EXPECT_FALSE(wire.powered());
}

TEST(PmacPartingF2, AKillThatWasLostIsSentAgain) {
    PmacWire wire;
    bool swallowed = false;
    wire.on_the_way = [&](std::string& bytes) {
        if (!swallowed && bytes.find('\x0B') != std::string::npos) {
            std::erase(bytes, '\x0B');
            swallowed = true;
        }
    };
    wire.leave();
    EXPECT_TRUE(swallowed);
    EXPECT_FALSE(wire.powered());
    EXPECT_EQ(wire.session.farewell(), "");
}

TEST(PmacPartingF2, AKillThatNobodyHearsIsToldAsLost) {
    PmacWire deaf;
    deaf.pass(0.5); // the card no longer watches over a motion
    deaf.on_the_way = [](std::string& bytes) { bytes.clear(); };
    deaf.leave();
    EXPECT_TRUE(deaf.powered());
    EXPECT_THAT(deaf.session.farewell(), testing::HasSubstr("did not report that its motors are disabled"));
    PmacWire cut;
    cut.on_the_way = [](std::string& bytes) { bytes.clear(); };
    cut.session.leave(cut.now);
    cut.pass(0.1);
    cut.cut();
    ASSERT_TRUE(cut.run_until([&] { return cut.state() != drivers::DriverState::stopping; }, 5.0));
    EXPECT_THAT(cut.session.farewell(), testing::HasSubstr("the connection was lost before"));
    PmacWire broken;
    broken.cut();
    broken.pass(0.1);
    broken.leave();
    EXPECT_THAT(broken.session.farewell(), testing::HasSubstr("whether the motors are still enabled"));
}

TEST(PmacPartingF2, PowerThatWasThereBeforeStaysWhereAPersonOnlyAsks) {
    PmacWire wire({}, true, "XYZA", {}, {}, nullptr, Parting::as_found);
    wire.leave(); // this link gave it
    EXPECT_FALSE(wire.powered());
    wire.come_back();
    for (int motor = 1; motor <= 4; ++motor) {
        wire.card.receive("#" + std::to_string(motor) + "J/\r"); // by somebody else
    }
    wire.pass(0.2);
    wire.session.closed();
    wire.come_back();
    ASSERT_TRUE(wire.powered());
    wire.leave();
    EXPECT_TRUE(wire.powered());
    EXPECT_EQ(wire.session.farewell(), "");
}

TEST(PmacPartingF2, PowerThatAPersonWantsKeptIsKept) {
    PmacWire wire({}, true, "XYZA", {}, {}, nullptr, Parting::keeps_power);
    wire.session.jog(jog_of(0, 40.0, 5.0), wire.now);
    wire.pass(1.0);
    wire.leave();
    wire.pass(0.5);
    EXPECT_TRUE(wire.powered());
    EXPECT_TRUE(wire.standing());
}

} // namespace
} // namespace millwright::pmac::internal
