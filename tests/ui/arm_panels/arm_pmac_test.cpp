// The Arm workspace at an emulated PMAC over TCP, in real time.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/ui/person/arm_at_pmac.h"
#include "ui/machine_panels/command_line_label.h"
#include "ui/window/view_panel.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using test::ArmAtPmac;

TEST(ArmAtPmacU2, NothingMovesAndNoMotorHasPowerByConnecting) {
    ArmAtPmac bench;
    bench.connect();
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_5").empty()); // four channels
}

TEST(ArmAtPmacU2, AJogGivesNoPower) {
    ArmAtPmac bench;
    bench.connect();
    EXPECT_EQ(bench.person.refusal("hand/jog/plus_1"), "The motors have no power.");
    EXPECT_EQ(bench.person.refusal("hand/power/machine_home"), "The motors have no power.");
    bench.point_at("hand/jog/plus_1");
    bench.person.hold_button(true);
    bench.person.frames(30);
    bench.person.hold_button(false);
    bench.person.frames(2);
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
}

TEST(ArmAtPmacU2, AJogRunsAsLongAsItIsHeldAndThePictureFollows) {
    ArmAtPmac bench;
    bench.connect();
    bench.jog("hand/jog/plus_1", 1);
    bench.person.keep("arm-pmac");
    bench.person.hold_button(false);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    EXPECT_GT(bench.pmac.degrees(1), 0.3);
    ASSERT_TRUE(bench.person.live_until([&] {
        return std::abs(to_degrees(bench.person.app().arm().joints()[0]) - bench.pmac.degrees(1)) < 0.1;
    }));
    EXPECT_NEAR(bench.pmac.degrees(2), 0.0, 0.1);
}

TEST(ArmAtPmacU2, TheKeysHomeSendRunLoadSettingsAndKill) {
    using render::Key;
    ArmAtPmac bench({1280, 1200}); // room for the whole pane
    const auto status = [&] { return bench.person.app().look().connection.status; };
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
               status().answer.state == drivers::CommandAnswer::State::done && bench.is(DriverState::idle);
    }));
    EXPECT_NEAR(bench.pmac.degrees(1), 0.0, 0.1); // sent, not run
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.click("lower/command");
    bench.person.type("LIST PROG 1");
    bench.person.press_key(Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return status().answer.number > before + 1 &&
               status().answer.state == drivers::CommandAnswer::State::done && bench.is(DriverState::idle);
    }));
    EXPECT_NE(status().answer.text.find("X5"), std::string::npos) << status().answer.text;

    bench.person.click("hand/jog/step/hold"); // out of the terminal's line
    bench.person.press_key(Key::r);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.pmac.degrees(1) > 4.9 && bench.rests(); }));
    EXPECT_TRUE(bench.is(DriverState::idle)) << status().message;
    EXPECT_NEAR(bench.pmac.degrees(2), -4.0, 0.1);

    bench.person.click("lower/command");
    bench.person.type("#1J=7200"); // 60 degrees
    bench.person.press_key(Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.pmac.degrees(1) > 7.0; }));
    bench.person.click("hand/jog/step/hold");
    bench.person.press_key(Key::slash); // stops whatever moves
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    EXPECT_LT(bench.pmac.degrees(1), 50.0);
    EXPECT_TRUE(bench.pmac.powered());

    int told = bench.newest_notice();
    bench.person.press_key(Key::i); // a wrong gain would move them
    EXPECT_FALSE(bench.person.sees("dialogs/files/open"));
    EXPECT_GT(bench.newest_notice(), told); // a key has no tip that tells why it does nothing
    bench.person.press_key(Key::k);
    EXPECT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::alarm) && !bench.pmac.any_power(); }));
    EXPECT_TRUE(bench.person.sees("alarm/message"));
    EXPECT_EQ(bench.person.refusal("hand/power/machine_home"), "Alarm: inspect the arm, then unlock it.");
    told = bench.newest_notice();
    bench.person.press_key(Key::equal);
    EXPECT_GT(bench.newest_notice(), told);
    bench.person.click("hand/connection/machine_reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.press_key(Key::i);
    EXPECT_TRUE(bench.person.sees("dialogs/files/open"));
    bench.person.press_key(Key::escape);
}

TEST(ArmAtPmacU2, ATipThatIsDraggedStaysAndSaysWhy) {
    ArmAtPmac bench({1600, 1000});
    bench.connect();
    const Vec3 before = bench.person.app().arm().tool().translation();
    const widgets::Point tip = bench.person.place("view/tip").centre();
    bench.person.drag(tip, {tip.x + 60.0F, tip.y + 40.0F});
    bench.person.frames(2);
    EXPECT_LT((bench.person.app().arm().tool().translation() - before).norm(), 1e-9);
    EXPECT_NE(bench.person.app().view_state().log.back().find("follows the connected arm"),
              std::string::npos);
    bench.person.keep("arm-dragged-connected");
}

TEST(ArmAtPmacU2, TheColonGivesTheKeyboardToTheTerminal) {
    using render::Key;
    ArmAtPmac bench;
    bench.connect();
    bench.give_power();
    bench.person.click("lower/tabs/program");
    bench.person.click("hand/jog/keys");
    bench.person.press_key(Key::semicolon, false, true);
    for (const auto& [key, letter] :
         {std::pair(Key::digit_1, "#"), std::pair(Key::h, "h"), std::pair(Key::s, "s")}) {
        bench.person.type(letter);
        bench.person.press_key(key, false, letter[0] == '#');
    }
    bench.person.type("1P");
    bench.person.live_until([] { return false; }, 0.3);
    EXPECT_LT(bench.pmac.last_motion(), 0.0);
    EXPECT_TRUE(bench.is(DriverState::idle));
    EXPECT_EQ(bench.person.app().view_state().manual.arm_joint, 0);
    bench.person.keep("arm-terminal");
    for (int n = 0; n < 4; ++n) {
        bench.person.press_key(Key::backspace);
    }
    bench.person.type("1P");
    const int before = bench.person.app().look().connection.status.answer.number;
    bench.person.press_key(Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        const auto& answer = bench.person.app().look().connection.status.answer;
        return answer.number > before && answer.state == drivers::CommandAnswer::State::done;
    }));
    EXPECT_EQ(bench.person.app().view_state().manual.console.commands.back(), "#1P");
}

TEST(ArmAtPmacU2, WhatIsTypedFastBehindTheColonIsForTheTerminal) {
    using render::Key;
    ArmAtPmac bench;
    bench.connect();
    bench.give_power();
    bench.person.click("lower/tabs/program");
    bench.person.click("hand/jog/keys");
    bench.person.hold_keys({Key::semicolon, Key::h, Key::x}); // all in the frame that sees the colon
    bench.person.type(":#");
    bench.person.hold_keys({});
    bench.person.type("1");
    bench.person.type("P");
    bench.person.frames(4);
    EXPECT_TRUE(bench.person.app().view_state().manual.arm_keys);
    EXPECT_TRUE(bench.is(DriverState::idle));
    bench.person.press_key(Key::enter);
    ASSERT_FALSE(bench.person.app().view_state().manual.console.commands.empty());
    EXPECT_EQ(bench.person.app().view_state().manual.console.commands.back(), "#1P");
}

TEST(ArmAtPmacU2, AnotherJointBeginsWithAnotherPress) {
    using render::Key;
    ArmAtPmac bench;
    bench.connect();
    bench.give_power();
    bench.person.click("hand/jog/keys");
    bench.person.press_key(Key::digit_3);
    bench.person.hold_keys({Key::minus});
    ASSERT_TRUE(bench.person.live_until([&] { return bench.pmac.degrees(3) < -0.1; }));
    bench.person.hold_keys({Key::minus, Key::digit_2});
    bench.person.frames(2);
    bench.person.hold_keys({Key::minus});
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    bench.person.live_until([] { return false; }, 0.5);
    EXPECT_NEAR(bench.pmac.degrees(2), 0.0, 0.05);
    bench.person.hold_keys({});
    bench.person.frames(2);
    EXPECT_EQ(bench.person.app().view_state().manual.arm_joint, 1);
}

TEST(ArmAtPmacF1, AProgramThatLeavesTheLimitsOfAJointIsNotRun) {
    using render::Key;
    ArmAtPmac bench;
    const auto status = [&] { return bench.person.app().look().connection.status; };
    bench.connect();
    bench.give_power();
    bench.person.app().run("machine.home");
    ASSERT_TRUE(bench.person.live_until(
        [&] { return status().position_known && bench.is(DriverState::idle); }, 60.0));
    constexpr double settled = 0.2; // s of the card: a motor comes to rest a little after the command
    ASSERT_TRUE(
        bench.person.live_until([&] { return bench.pmac.time() > bench.pmac.last_motion() + settled; }));
    const double before = bench.pmac.last_motion();
    bench.person.click("lower/tabs/program");
    bench.person.click("lower/text");
    bench.person.type("F40\nX20Y-6\nX400");
    bench.person.click("lower/arm_run_program");
    bench.person.frames(4);
    bench.person.keep("arm-beyond-limits");
    bench.person.live_until([] { return false; }, 0.5);
    EXPECT_EQ(bench.pmac.last_motion(), before);
    EXPECT_TRUE(bench.is(DriverState::idle));
    bench.person.click("lower/arm_simulate");
    ASSERT_TRUE(bench.person.live_until([&] {
        const auto& faults = bench.person.app().arm().program().faults();
        return !faults.empty() &&
               faults.front().message.find("X (joint 1) exceeds its limits") != std::string::npos;
    }));
    EXPECT_EQ(bench.person.app().arm().program().faults().front().place.line, 3);
    bench.person.frames(3); // from elsewhere it may be sound: it can be asked again, and is refused again
    bench.person.keep("arm-beyond-limits-simulated");
    for (const std::string& cut : bench.person.desktop().ui().cut_texts()) {
        EXPECT_THAT(cut, testing::Not(testing::HasSubstr("limits")));
    }
    EXPECT_EQ(bench.person.refusal("lower/arm_simulate"), "");
    bench.person.click("lower/arm_run_program");
    bench.person.live_until([] { return false; }, 0.5);
    EXPECT_EQ(bench.pmac.last_motion(), before);
}

TEST(ArmAtPmacF2, LosingTheFocusEndsAJogThatIsStillHeld) {
    ArmAtPmac bench;
    bench.connect();
    bench.jog("hand/jog/minus_3", 3);
    bench.person.set_focused(false);
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

/// What the card refused in an alarm is no news when it is over.
TEST(ArmAtPmacU6, ARedNoticeOfAFaultGoesWithIt) {
    ArmAtPmac bench;
    bench.connect();
    bench.person.app().run("machine.emergency_stop");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    actions::ActionQueue asked;
    asked.tell([](drivers::Driver& driver) { driver.home(); });
    asked.show([](actions::ViewState&) { throw Error("the disk is full"); });
    bench.person.app().perform(asked, true);
    bench.person.frames(3);
    const int last = bench.newest_notice();
    ASSERT_GE(last, 2);
    EXPECT_TRUE(bench.person.sees("notices/" + std::to_string(last - 1)));
    bench.person.app().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.frames(3);
    EXPECT_FALSE(bench.person.sees("notices/" + std::to_string(last - 1)));
    EXPECT_TRUE(bench.person.sees("notices/" + std::to_string(last)));
}

/// No frame comes that would renew the jog, and none that would end it: that is the driver's part, or the
/// card's own.
TEST(ArmAtPmacF2, AWindowThatHangsEndsAJogThatIsStillHeldAndBeginsNoneAnew) {
    constexpr double renewed_deg = 5.0; // as far as a jog goes that nothing ends
    ArmAtPmac bench;
    bench.connect();
    ASSERT_NO_FATAL_FAILURE(bench.jog("hand/jog/plus_1", 1));
    const double hung_at = bench.pmac.degrees(1), hung = bench.pmac.time();
    const auto hangs_long_enough = [&] { // by the card's time, which is never ahead of this computer's
        return !bench.pmac.moving() && bench.pmac.time() > hung + 1.0;
    };
    constexpr int most_looks = 60'000;
    for (int n = 0; n < most_looks && !hangs_long_enough(); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(hangs_long_enough());
    EXPECT_LT(bench.pmac.degrees(1) - hung_at, 0.5 * renewed_deg);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
    const double there = bench.pmac.degrees(1);
    bench.person.frames(30); // with the button down
    EXPECT_NEAR(bench.pmac.degrees(1), there, 0.05);
    bench.person.hold_button(false);
}

TEST(ArmAtPmacF2, LeavingTheWorkspaceEndsAJog) {
    ArmAtPmac bench;
    bench.connect();
    bench.jog("hand/jog/plus_4", 4);
    bench.person.app().run("view.design");
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacF2, AKillTakesThePowerAndNoJogGivesItBack) {
    ArmAtPmac bench;
    bench.connect();
    bench.jog("hand/jog/plus_2", 2);
    bench.person.app().run("machine.emergency_stop");
    ASSERT_TRUE(
        bench.person.live_until([&] { return bench.is(DriverState::alarm) && !bench.pmac.any_power(); }));
    bench.person.frames(30); // the button is still held
    EXPECT_FALSE(bench.pmac.any_power());
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_2").empty());
    EXPECT_FALSE(bench.person.refusal("hand/power/arm_enable").empty());
    bench.person.hold_button(false);
    bench.person.app().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    EXPECT_FALSE(bench.pmac.any_power()); // looked at, and still without
    bench.person.keep("arm-killed");
}

/// What stopped the arm is not undone by a key that was never released.
TEST(ArmAtPmacF2, AKeyThatIsHeldMovesNothingAfterAStop) {
    using render::Key;
    ArmAtPmac bench;
    bench.connect();
    bench.give_power();
    bench.person.click("hand/jog/keys");
    bench.person.press_key(Key::digit_1);
    const auto jog = [&] {
        const double before = bench.pmac.degrees(1);
        for (int n = 0; n < 20 && std::abs(bench.pmac.degrees(1) - before) < 0.3; ++n) {
            bench.person.hold_keys({});
            bench.person.live_until([&] { return bench.rests(); });
            bench.person.frames(2);
            bench.person.hold_keys({Key::equal});
            bench.person.live_until([&] { return std::abs(bench.pmac.degrees(1) - before) > 0.3; }, 1.5);
        }
        EXPECT_GT(std::abs(bench.pmac.degrees(1) - before), 0.3);
    };
    const auto nothing_begins = [&](const char* after) {
        const testing::ScopedTrace trace(__FILE__, __LINE__, after);
        EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
        const double before = bench.pmac.degrees(1);
        bench.person.live_until([] { return false; }, 1.0);
        EXPECT_NEAR(bench.pmac.degrees(1), before, 0.02);
    };
    jog();
    bench.person.hold_keys({Key::equal, Key::slash});
    bench.person.frames(2);
    bench.person.hold_keys({Key::equal});
    nothing_begins("/");
    jog();
    bench.person.hold_keys({Key::equal, Key::k});
    bench.person.frames(2);
    bench.person.hold_keys({Key::equal});
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    bench.person.app().run("machine.reset");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.app().run("arm.enable");
    EXPECT_TRUE(bench.person.live_until([&] { return bench.pmac.powered(); }));
    nothing_begins("a kill, and power again");
    jog();
    bench.person.hold_keys({});
    EXPECT_TRUE(bench.person.live_until([&] { return bench.rests(); }));
}

TEST(ArmAtPmacU6, APulledPlugIsToldAndJogsAreRefused) {
    ArmAtPmac bench;
    bench.connect();
    bench.pmac.vanish();
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::alarm); }));
    EXPECT_TRUE(
        bench.person.live_until([&] { return bench.person.app().look().connection.status.link_lost; }));
    EXPECT_FALSE(bench.person.refusal("hand/jog/plus_1").empty());
}

TEST(ArmAtPmacU6, ACardThatIsNotThereIsToldInTheWindow) {
    ArmAtPmac bench;
    bench.person.app().view_state().manual.choice.address = "/dev/no-such-port";
    bench.person.click("hand/connection/machine_connect");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.sees("hand/connection/failure"); }));
}

TEST(ArmAtPmacU4, TheTerminalAsksTheCardAndShowsItsErrors) {
    ArmAtPmac bench;
    bench.connect();
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.click("lower/command");
    bench.person.type("I122");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.app().look().connection.status.answer.state ==
               drivers::CommandAnswer::State::done;
    }));
    ASSERT_TRUE(bench.person.live_until([&] { return bench.is(DriverState::idle); }));
    bench.person.click("lower/command");
    bench.person.type("NONSENSE");
    bench.person.press_key(render::Key::enter);
    ASSERT_TRUE(bench.person.live_until([&] {
        return bench.person.app().look().connection.status.answer.state ==
               drivers::CommandAnswer::State::refused;
    }));
    std::vector<drivers::ConsoleLine> lines;
    (void)bench.person.app().connection().driver()->console()->read(0, lines, 100'000);
    std::vector<std::string> texts;
    for (const drivers::ConsoleLine& line : lines) {
        texts.push_back((line.sent ? "> " : "") + line.text);
    }
    EXPECT_THAT(texts, testing::IsSupersetOf({"> I122", "32", "> NONSENSE"}));
    EXPECT_THAT(texts, testing::Contains(testing::StartsWith("ERR003")));
    bench.person.frames(2);
    bench.person.keep("arm-terminal");
}

/// Played later, such a point would send the arm to where it never stood.
TEST(ArmAtPmacC6, NoPointIsTaughtWhileThePositionIsNotKnown) {
    constexpr const char* why = "The position is unknown: home the arm first.";
    ArmAtPmac bench;
    const auto status = [&] { return bench.person.app().look().connection.status; };
    bench.person.app().run("arm.teach"); // of the drawn arm
    bench.connect();
    ASSERT_FALSE(status().position_known);
    bench.person.click("lower/tabs/points");
    bench.person.frames(2);
    bench.person.click("lower/points/point_1");
    bench.person.frames(2);
    EXPECT_EQ(bench.person.refusal("lower/arm_teach"), why);
    EXPECT_EQ(bench.person.refusal("lower/again"), why);
    bench.person.keep("arm-teach-refused");
    bench.give_power();
    bench.person.app().run("machine.home");
    ASSERT_TRUE(bench.person.live_until(
        [&] { return status().position_known && bench.is(DriverState::idle); }, 60.0));
    bench.person.frames(2);
    EXPECT_EQ(bench.person.refusal("lower/again"), "");
    bench.person.click("lower/arm_teach");
    EXPECT_EQ(bench.person.project().arm.points.size(), 2U);
}

TEST(ArmAtPmacU2, ATaughtPointIsChosenAndInSight) {
    ArmAtPmac bench({1280, 800});
    bench.person.click("lower/tabs/points");
    for (int n = 0; n < 12; ++n) {
        bench.person.app().run("arm.teach");
        bench.person.frames(2);
        EXPECT_TRUE(bench.person.sees("lower/points/point_" + std::to_string(n + 1))) << n;
    }
    EXPECT_FALSE(bench.person.sees("lower/points/point_1")); // they do not all have room
    EXPECT_EQ(bench.person.refusal("lower/remove"), "");     // one is chosen
    bench.person.keep("arm-taught-twelve");
}

TEST(ArmAtPmacU2, TheJogButtonsAreInSightInASmallWindow) {
    ArmAtPmac bench({1100, 700});
    bench.connect();
    bench.person.frames(4);
    for (const char* button : {"hand/power/arm_enable",
                               "hand/power/machine_emergency_stop",
                               "hand/jog/plus_1",
                               "hand/jog/minus_4",
                               "hand/jog/plus_5"}) {
        EXPECT_LT(bench.person.place(button).bottom(), bench.person.place("lower/tabs/console").y) << button;
    }
    bench.person.keep("arm-jog-small");
}

TEST(ArmAtPmacU4, TheLineOfTheTerminalIsNoGCode) {
    ArmAtPmac bench;
    EXPECT_EQ(command_line_label(bench.person.app().look()), "MDI");
    bench.connect();
    EXPECT_EQ(command_line_label(bench.person.app().look()), "Line");
    bench.person.click("lower/tabs/console");
    bench.person.frames(2);
    bench.person.keep("arm-terminal-line");
}

TEST(ArmAtPmacU2, ALineOfAFileThatTheCardRefusesIsToldWithItsPlace) {
    ArmAtPmac bench;
    const auto& log = bench.person.app().view_state().log;
    bench.connect();
    const auto file = bench.person.folder() / "own.ini";
    write_file(file, "; ours\nI122=30\nI9999=3\n");
    bench.person.app().load_card_settings(file);
    ASSERT_TRUE(bench.person.live_until([&] { return log.back().find("rejected") != std::string::npos; }));
    EXPECT_THAT(log.back(), testing::HasSubstr("line 3: 'I9999=3' is rejected"));
}

TEST(ArmAtPmac, TakesNoGCode) {
    ArmAtPmac bench;
    bench.connect();
    bench.person.app().run("view.machine");
    bench.person.wait_idle();
    const auto now = bench.person.app().look();
    EXPECT_FALSE(bench.person.app().catalogue().find("machine.run").permission(now).allowed);
}

// It spoke of mm/min on joints, sent G10 to the card, and showed the table of another machine.
TEST(ArmAtPmac, TheMachineWorkspaceShowsTheArmThatIsConnected) {
    ArmAtPmac bench;
    bench.connect();
    bench.person.app().run("view.machine");
    bench.person.frames(4);
    bench.person.keep("machine-at-arm");
    for (const char* const of_a_mill : {"hand/jog/speed",
                                        "hand/position/zero_X",
                                        "inspector/job/machine_run",
                                        "inspector/job/speed",
                                        "inspector/overrides/feed_less"}) {
        EXPECT_FALSE(bench.person.sees(of_a_mill)) << of_a_mill;
    }
    EXPECT_TRUE(bench.person.sees("hand/position/axes/X"));
    EXPECT_TRUE(bench.person.sees("inspector/connection/machine_disconnect"));
    EXPECT_TRUE(scene_of(bench.person.app().look()).arm.has_value());
    bench.person.click("hand/view_arm");
    EXPECT_EQ(bench.person.app().view_state().workspace, actions::Workspace::arm);
    bench.person.app().run("view.machine");
    bench.person.frames(3);
    bench.person.click("inspector/connection/machine_disconnect");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.person.app().look().connection.connected(); }));
    bench.person.frames(3);
    EXPECT_FALSE(scene_of(bench.person.app().look()).arm.has_value());
    EXPECT_TRUE(bench.person.sees("inspector/job/machine_run"));
}

} // namespace
} // namespace millwright::panels
