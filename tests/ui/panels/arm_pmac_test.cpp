// The Arm workspace at an emulated PMAC over TCP, in real time.
#include "core/base/units.h"
#include "tests/ui/panels/arm_at_pmac.h"
#include "ui/actions/arm_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using machine::DriverState;
using Bench = test::ArmAtPmac;

TEST(ArmAtPmacU2, NothingMovesAndNoMotorHasPowerByConnecting) {
    Bench bench;
    bench.connect();
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_5").empty()); // four channels
}

TEST(ArmAtPmacU2, AJogGivesNoPower) {
    Bench bench;
    bench.connect();
    bench.point_at("hand/jog/plus_1");
    bench.person.hold_button(true);
    bench.person.frames(30);
    bench.person.hold_button(false);
    bench.person.frames(2);
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
}

TEST(ArmAtPmacU2, AJogRunsAsLongAsItIsHeldAndThePictureFollows) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_1", 1);
    bench.person.keep("arm-pmac");
    bench.person.hold_button(false);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    EXPECT_GT(bench.pmac.degrees(1), 0.3);
    ASSERT_TRUE(bench.person.live_until([&] {
        return std::abs(to_degrees(bench.person.workshop().arm().joints()[0]) - bench.pmac.degrees(1)) < 0.1;
    }));
    EXPECT_NEAR(bench.pmac.degrees(2), 0.0, 0.1);
}

TEST(ArmAtPmacU2, TheKeysHomeSendRunLoadSettingsAndKill) {
    using render::Key;
    Bench bench({1280, 1200}); // room for the whole pane
    const auto status = [&] { return bench.person.workshop().look().controller.status; };
    bench.connect();
    bench.person.click("lower/tabs/program");
    bench.person.frames(2);
    bench.person.click("lower/text");
    bench.person.type("ABS LINEAR\nTM500 TA100\nX5 Y-4");
    bench.person.click("hand/jog/keys");
    bench.give_power();
    bench.person.press_key(Key::h);
    ASSERT_TRUE(
        bench.person.live_until([&] { return status().position_known && bench.is(DriverState::idle); }, 60.0))
        << to_text(status().state) << ' ' << status().message;

    const int before = status().answer.number;
    bench.person.press_key(Key::s);
    ASSERT_TRUE(bench.person.live_until([&] {
        return status().answer.number > before &&
               status().answer.state == machine::CommandAnswer::State::done && bench.is(DriverState::idle);
    }));
    EXPECT_NEAR(bench.pmac.degrees(1), 0.0, 0.1); // sent, not run
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.click("lower/command");
    bench.person.type("LIST PROG 1");
    bench.person.press_key(Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return status().answer.number > before + 1 &&
               status().answer.state == machine::CommandAnswer::State::done && bench.is(DriverState::idle);
    }));
    EXPECT_NE(status().answer.text.find("X5"), std::string::npos) << status().answer.text;

    bench.person.click("hand/jog/step/hold"); // out of the terminal's line
    bench.person.press_key(Key::r);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.pmac.degrees(1) > 4.9 && bench.rests(); }));
    EXPECT_TRUE(bench.is(DriverState::idle)) << status().message;
    EXPECT_NEAR(bench.pmac.degrees(2), -4.0, 0.1);

    bench.person.press_key(Key::i);
    EXPECT_TRUE(bench.person.sees("dialogs/files/open"));
    bench.person.press_key(Key::escape);
    bench.person.press_key(Key::k);
    EXPECT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::alarm) && !bench.pmac.any_power(); }));
    EXPECT_TRUE(bench.person.sees("hand/messages/message"));
}

TEST(ArmAtPmacF2, LosingTheFocusEndsAJogThatIsStillHeld) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/minus_3", 3);
    bench.person.set_focused(false);
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacF2, LeavingTheWorkspaceEndsAJog) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_4", 4);
    bench.person.workshop().run("view.design");
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacF2, AKillTakesThePowerAndNoJogGivesItBack) {
    Bench bench;
    bench.connect();
    bench.jog("hand/jog/plus_2", 2);
    bench.person.workshop().run("machine.emergency_stop");
    ASSERT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::alarm) && !bench.pmac.any_power(); }));
    bench.person.frames(30); // the button is still held
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_2").empty());
    EXPECT_FALSE(bench.person.refusal("hand/power/arm_enable").empty());
    bench.person.hold_button(false);
    bench.person.workshop().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    EXPECT_FALSE(bench.pmac.any_power()); // looked at, and still without
    bench.person.keep("arm-killed");
}

TEST(ArmAtPmacU6, APulledPlugIsToldAndJogsAreRefused) {
    Bench bench;
    bench.connect();
    bench.pmac.vanish();
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    EXPECT_TRUE(
        bench.person.live_until([&] { return bench.person.workshop().look().controller.status.link_lost; }));
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_1").empty());
}

TEST(ArmAtPmacU6, ACardThatIsNotThereIsToldInTheWindow) {
    Bench bench;
    bench.person.workshop().session().hand.choice.address = "/dev/no-such-port";
    bench.person.click("hand/connection/machine_connect");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.sees("hand/connection/failure"); }));
}

TEST(ArmAtPmacU4, TheTerminalAsksTheCardAndShowsItsErrors) {
    Bench bench;
    bench.connect();
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.click("lower/command");
    bench.person.type("I122");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.workshop().look().controller.status.answer.state ==
               machine::CommandAnswer::State::done;
    }));
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.click("lower/command");
    bench.person.type("NONSENSE");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.workshop().look().controller.status.answer.state ==
               machine::CommandAnswer::State::refused;
    }));
    bench.person.keep("arm-terminal");
}

TEST(ArmAtPmac, TakesNoGCode) {
    Bench bench;
    bench.connect();
    bench.person.workshop().run("view.machine");
    bench.person.wait_idle();
    const auto now = bench.person.workshop().look();
    EXPECT_FALSE(bench.person.workshop().catalogue().find("machine.run").permission(now).allowed);
}

} // namespace
} // namespace millwright::panels
