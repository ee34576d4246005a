#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using testing::HasSubstr;

std::string zigzag_with_spindle(int lines) {
    std::string text = "(zigzag)\nG21 G90 G94\nG0 Z5\nM3 S1000\nG1 Z-1 F600\n";
    for (int n = 0; n < lines; ++n) {
        text += "G1 X" + std::to_string(n % 2 == 0 ? 10 : 0) + " Y" + std::to_string(n) + " F1500\n";
    }
    return text + "G0 Z5\nM5\nM30\n";
}

int executed_lines(const emulators::GrblEmulator& grbl) {
    int count = 0;
    for (const emulators::TruthLine& line : grbl.truth().lines) {
        count += line.executed >= 0.0 ? 1 : 0;
    }
    return count;
}

TEST(GrblSession, FindsTheControllerAndAsksItForEverything) {
    const GrblWire wire;
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.session.readout().version, "1.1h");
    EXPECT_EQ(wire.session.readout().settings.size(), 34u);
    EXPECT_EQ(wire.session.readout().planner_blocks, 15);
}

TEST(GrblSession, RunsAProgramToItsEnd) {
    for (const bool one_by_one : {false, true}) {
        GrblWire wire({}, {}, {.one_by_one = one_by_one});
        wire.start(zigzag_with_spindle(40));
        EXPECT_EQ(wire.state(), DriverState::running);
        EXPECT_TRUE(wire.run_to_end());
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
        EXPECT_EQ(wire.session.status().executed_blocks, 48);
        EXPECT_EQ(executed_lines(wire.grbl), 47);
        EXPECT_EQ(wire.grbl.truth().lost_bytes, 0);
        EXPECT_EQ(wire.session.status().position[1], 39.0);
    }
}

TEST(GrblSession, NeverClaimsMoreThanWasExecuted) {
    for (const bool numbers : {false, true}) {
        GrblWire wire({}, {.line_numbers = numbers});
        wire.grbl.receive("$10=3\n");
        wire.run_until([] { return false; }, 0.2);
        wire.start(zigzag_with_spindle(60));
        int claimed = 0;
        while (wire.state() == DriverState::running) {
            wire.step();
            const int blocks = wire.session.status().executed_blocks;
            EXPECT_LE(blocks, executed_lines(wire.grbl) + 1); // the comment on top is a block
            claimed = wire.state() == DriverState::running ? std::max(claimed, blocks) : claimed;
        }
        EXPECT_EQ(wire.state(), DriverState::idle);
        EXPECT_GT(claimed, 40);
    }
}

TEST(GrblSession, KeepsThePlannerFullAtAThousandBlocksASecond) {
    GrblWire wire;
    for (const char* setting : {"$110=60000", "$111=60000", "$120=5000", "$121=5000"}) {
        wire.grbl.receive(std::string(setting) + "\n");
        wire.grbl.advance(0.1);
    }
    (void)wire.grbl.take_output();
    std::string program = "G1 F6000\n";
    for (int n = 1; n <= 2000; ++n) {
        program += "X" + std::to_string(n / 10) + "." + std::to_string(n % 10) + "\n";
    }
    wire.start(program);
    int steps = 0;
    int starved = 0;
    while (wire.state() == DriverState::running) {
        wire.step(0.001);
        ++steps;
        const double x = wire.grbl.position()[0];
        starved += x > 1.0 && x < 190.0 && wire.grbl.planned_blocks() < 8 ? 1 : 0;
    }
    EXPECT_EQ(starved, 0);
    EXPECT_LT(steps, 2600); // 2000 blocks at 1000 per second, and the end
}

TEST(GrblSession, HoldsAndResumes) {
    GrblWire wire;
    wire.start(zigzag_with_spindle(20));
    wire.run_until([&] { return wire.grbl.position()[1] > 3.0; }, 60.0);
    wire.session.hold(wire.now);
    EXPECT_EQ(wire.state(), DriverState::holding);
    wire.run_until([] { return false; }, 2.0);
    const auto there = wire.grbl.position();
    wire.run_until([] { return false; }, 5.0);
    EXPECT_EQ(wire.grbl.position(), there);
    EXPECT_EQ(wire.state(), DriverState::holding);
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.session.status().executed_blocks, 28);
}

TEST(GrblSession, StopsAtRestWithItsPositionKept) {
    GrblWire wire;
    wire.start(zigzag_with_spindle(20));
    wire.run_until([&] { return wire.grbl.position()[1] > 3.0; }, 60.0);
    wire.session.stop(wire.now);
    EXPECT_EQ(wire.state(), DriverState::stopping);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::stopped) << wire.session.status().message;
    const double rest = wire.now;
    wire.run_until([] { return false; }, 5.0);
    EXPECT_LT(wire.grbl.truth().last_motion + 1000.0, rest);
    EXPECT_LE(wire.session.status().executed_blocks, executed_lines(wire.grbl) + 1);
    wire.start("G0 X0 Y0\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[1], 0.0);
}

TEST(GrblSession, CutsMotionOffInAnEmergency) {
    GrblWire wire;
    wire.start(zigzag_with_spindle(20));
    wire.run_until([&] { return wire.grbl.position()[1] > 3.0; }, 60.0);
    wire.session.emergency_stop(wire.now);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    wire.step();
    wire.step();
    const auto there = wire.grbl.position();
    wire.run_until([] { return false; }, 5.0);
    EXPECT_EQ(wire.grbl.position(), there);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("alarm 3"));
    EXPECT_THROW(wire.start("G0 X0\n"), Error);
    wire.session.reset(wire.now);
    EXPECT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position(), there);
}

TEST(GrblSession, StopsAtALineThatIsRefusedAndNamesIt) {
    GrblWire wire;
    wire.start("G0 X10\nG0 X20\nG1 X30\nG0 X40\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message,
                HasSubstr("line 3 was refused, error 22: the feed rate is not set"));
    wire.run_until([] { return false; }, 3.0);
    EXPECT_LT(wire.grbl.position()[0], 40.0);
}

TEST(GrblSession, ExplainsAnAlarm) {
    GrblWire wire;
    wire.start("G38.2 Z-1 F100\nG0 X10\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("alarm 5: the probe did not make contact"));
    EXPECT_EQ(wire.grbl.position()[0], 0.0);
}

TEST(GrblSession, TellsWhereTheProbeTouched) {
    GrblWire wire({}, {.surface = [](double, double) { return -3.25; }});
    wire.start("G38.2 Z-10 F100\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    ASSERT_TRUE(wire.session.status().probe);
    EXPECT_TRUE(wire.session.status().probe->touched);
    EXPECT_EQ(wire.session.status().probe->number, 1);
    EXPECT_NEAR(wire.session.status().probe->position[2], -3.25, 0.001);
}

TEST(GrblSession, SetsOverridesFromAnyState) {
    GrblWire wire;
    wire.session.set_overrides({.feed = 137, .rapid = 25, .spindle = 64});
    wire.run_until([] { return false; }, 2.0);
    EXPECT_EQ(wire.session.status().overrides, (Overrides{137, 25, 64}));
}

/// Real Grbl takes the bytes that came between two passes of its loop for flags.
TEST(GrblSession, SendsNoOverrideByteTwiceBeforeAReportHasShownTheFirst) {
    GrblWire wire;
    wire.sent.clear();
    wire.session.set_overrides({.feed = 200, .rapid = 50, .spindle = 13});
    std::string since_report;
    Overrides shown;
    wire.run_until(
        [&] {
            const Overrides before = std::exchange(shown, wire.session.status().overrides);
            since_report = shown == before ? since_report : std::string();
            for (const char byte : std::exchange(wire.sent, {})) {
                EXPECT_TRUE(byte == '?' || since_report.find(byte) == std::string::npos);
                since_report += byte;
            }
            return shown == Overrides{200, 50, 13};
        },
        10.0);
    EXPECT_EQ(wire.session.status().overrides, (Overrides{200, 50, 13}));
}

TEST(GrblSession, GoesFromOneOverrideToAnotherWithoutPassingThroughTheStandard) {
    GrblWire wire;
    const auto feed = [&] { return wire.session.status().overrides.feed; };
    int most = 0;
    const auto change = [&](int percent) {
        wire.session.set_overrides({.feed = percent});
        most = 0;
        wire.run_until(
            [&] {
                most = std::max(most, feed());
                return feed() == percent;
            },
            10.0);
        EXPECT_EQ(feed(), percent);
    };
    change(20);
    change(10);
    EXPECT_LE(most, 20);
    change(34);
    EXPECT_LE(most, 34);
}

TEST(GrblSession, SendsAnOverrideAgainThatWasLostOnTheWay) {
    GrblWire wire({.drop = 0.3, .toward_host = false, .seed = 3});
    wire.session.set_overrides({.feed = 150});
    EXPECT_TRUE(wire.run_until([&] { return wire.session.status().overrides.feed == 150; }, 200.0));
}

TEST(GrblSession, LeavesOverridesAloneThatSomebodyElseSets) {
    GrblWire wire;
    wire.grbl.receive("\x92");
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.session.status().overrides.feed, 90);
    wire.run_until([] { return false; }, 3.0);
    EXPECT_EQ(wire.session.status().overrides.feed, 90);
}

TEST(GrblSession, ShowsAPauseOfTheProgramAsAHold) {
    GrblWire wire;
    wire.start("G0 X1\nM0\nG0 X2\n");
    wire.run_until([&] { return wire.state() == DriverState::holding; }, 10.0);
    EXPECT_THAT(wire.session.status().message, HasSubstr("M0"));
    wire.session.resume(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[0], 2.0);
}

TEST(GrblSession, KnowsAllBeforeAPauseThatFindsThePlannerEmpty) {
    GrblWire wire;
    wire.grbl.receive("$10=3\n");
    wire.run_until([] { return false; }, 0.2);
    wire.start("G21 G90 F600\nG1 X1\nX2\nX3\nM0\nX4\nX5\nX6\n");
    wire.run_until([&] { return wire.session.status().executed_blocks == 4; }, 20.0);
    EXPECT_EQ(wire.session.status().executed_blocks, 4);
    EXPECT_EQ(executed_lines(wire.grbl), 4);
    wire.session.resume(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.session.status().executed_blocks, 8);
}

TEST(GrblSession, ClaimsNothingOfWhatAHoldHasInterrupted) {
    for (int n = 1; n < 12; ++n) {
        GrblWire wire;
        wire.grbl.receive("$10=3\n");
        wire.run_until([] { return false; }, 0.2);
        wire.start("G21 G90 F600\nG1 X1\nX2\nX3\nM0\nX4\n");
        wire.run_until([] { return false; }, 0.03 * n);
        wire.session.hold(wire.now);
        wire.run_until([] { return false; }, 1.0);
        EXPECT_LE(wire.session.status().executed_blocks, executed_lines(wire.grbl)) << n;
    }
}

TEST(GrblSession, ShowsTheBlockAtHandWhereReportsTellIt) {
    GrblWire wire;
    wire.grbl.receive("$10=3\n");
    wire.run_until([] { return false; }, 0.2);
    wire.start("G21 G90 F600\nG1 X5\nX10\nX15\nX20\nX25\n");
    int shown = 0;
    wire.run_until(
        [&] {
            const DriverStatus now = wire.session.status();
            EXPECT_GE(now.block, std::min(now.executed_blocks, 5));
            shown = std::max(shown, now.executed_blocks < 2 ? now.block : 0);
            return now.state != DriverState::running;
        },
        60.0);
    EXPECT_GE(shown, 4); // long before that is certain
}

TEST(GrblSession, RefusesALineThatIsTooLongWhereItIsTooLong) {
    GrblWire wire;
    const std::string before = "G1 (a) X1 Y0.";
    const std::string digits(80, '1'); // behind 7 characters that count
    for (const std::string head : {"", "N10 "}) {
        try {
            wire.start("G21\n" + head + before + digits + "\n");
            ADD_FAILURE() << "it was taken";
        } catch (const Error& error) {
            const Place& place = error.diagnostic().place;
            EXPECT_EQ(place.line, 2);
            constexpr int counted_before = 7;
            constexpr int longest = 79;
            EXPECT_EQ(place.column,
                      static_cast<int>(head.size() + before.size()) + longest - counted_before + 1);
        }
    }
}

// As when the disk or the whole computer stood still: then it was not the controller that said nothing.
TEST(GrblSession, DoesNotTakeItsOwnPauseForTheControllersSilence) {
    for (int n = 0; n < 30; ++n) {
        GrblWire wire;
        wire.start("G21 G90 F300\nG1 X10\nX20\nX30\nX40\n");
        wire.run_until([] { return false; }, 0.5 + 0.005 * n);
        wire.step(3.0);
        wire.run_to_end();
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
        EXPECT_EQ(wire.session.status().executed_blocks, 5);
    }
}

TEST(GrblSession, WaitsForALongDwell) {
    GrblWire wire;
    wire.start("G0 X1\nG4 P20\nG0 X2\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
}

TEST(GrblSession, WaitsForADwellThatIsWrittenWithAPlus) {
    GrblWire wire;
    wire.start("G0 X1\nG4 P+9\nG0 X+2\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.grbl.position()[0], 2.0);
}

TEST(GrblSession, HomesAndUnlocks) {
    GrblWire wire;
    test::store_settings(wire.grbl, "$22=1\n$25=3000\n");
    wire.run_until([] { return false; }, 0.5);
    wire.session.home(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[0], -1.0);
}

TEST(GrblSession, NoticesThatTheControllerIsSilent) {
    GrblWire wire({.stall = 1500, .toward_controller = false});
    wire.start(zigzag_with_spindle(50));
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("no longer answers"));
    EXPECT_FALSE(wire.grbl.moving());
}

TEST(GrblSession, NoticesThatAnAcknowledgementWasLost) {
    GrblWire wire({.lost_ok = 0.1, .seed = 5});
    wire.start(zigzag_with_spindle(30));
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("acknowledgement"));
}

/// On a busy computer at the other end: it has had time for a word each 1.5 s, and may come to the line yet.
TEST(GrblSession, GivesAControllerThatIsKeptFromItsWorkTimeToAnswer) {
    GrblWire wire;
    wire.start("G0 X1\n");
    const auto says = [&wire](const std::string& bytes) {
        for (int n = 0; n < 15; ++n) {
            wire.now += 0.1;
            wire.session.tick(wire.now);
            (void)wire.session.take_output();
        }
        wire.session.receive(bytes, wire.now);
        wire.session.tick(wire.now);
    };
    const std::string idle = "<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n";
    for (int n = 0; n < 6; ++n) {
        says(idle); // 9 s in all
    }
    EXPECT_EQ(wire.state(), DriverState::running) << wire.session.status().message;
    for (int n = 0; n < 6; ++n) {
        says(idle);
    }
    EXPECT_EQ(wire.state(), DriverState::stopping);
}

/// After a limit switch Grbl does nothing until a reset, and does not say so to who comes later.
TEST(GrblSession, WakesAControllerThatALimitSwitchHasMadeDeaf) {
    GrblWire wire;
    wire.grbl.raise_alarm();
    (void)wire.grbl.take_output(); // before anybody listened
    wire.session = GrblSession();
    wire.session.opened(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
    EXPECT_FALSE(wire.session.stranger()) << wire.session.stranger()->message;
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_NE(wire.session.status().position_doubt, "");
}

/// As after a job whose program was killed, or whose link broke: what the controller has goes on.
void find_moving(GrblWire& wire) {
    wire.grbl.receive("G1 X50 F600\nG1 Y20\n");
    wire.grbl.advance(0.1);
    wire.session = GrblSession();
    wire.session.opened(wire.now);
    wire.sent.clear();
    EXPECT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
    EXPECT_FALSE(wire.session.stranger());
    EXPECT_EQ(wire.state(), DriverState::running);
    EXPECT_TRUE(wire.grbl.moving());
}

TEST(GrblSession, LeavesAMovingControllerAloneUntilItStands) {
    GrblWire wire;
    find_moving(wire);
    Jog jog;
    jog.way = kinematics::AxisPositions{Vec3(1.0, 0.0, 0.0)};
    jog.speed = 10.0;
    EXPECT_THROW(wire.session.jog(jog, wire.now), Error);
    EXPECT_THROW(wire.start("G0 X0\n"), Error);
    EXPECT_THROW(wire.session.home(wire.now), Error);
    ASSERT_TRUE(wire.run_until([&] { return !wire.grbl.moving(); }, 20.0));
    EXPECT_EQ(wire.sent.find_first_not_of('?'), std::string::npos) << wire.sent;
    EXPECT_NEAR(wire.grbl.position()[1], 20.0, 0.01); // all that it had
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0));
    EXPECT_FALSE(wire.session.readout().settings.empty());
    EXPECT_EQ(wire.session.status().position_doubt, "");
}

TEST(GrblSession, StopsAControllerThatItFoundMoving) {
    GrblWire wire;
    find_moving(wire);
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0));
    EXPECT_FALSE(wire.grbl.moving());
    EXPECT_LT(wire.grbl.position()[0], 20.0);
    EXPECT_FALSE(wire.session.readout().settings.empty());
}

TEST(GrblSession, HoldsAndResumesAControllerThatItFoundMoving) {
    GrblWire wire;
    find_moving(wire);
    wire.session.hold(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return !wire.grbl.moving(); }, 2.0));
    EXPECT_EQ(wire.state(), DriverState::holding);
    wire.run_until([] { return false; }, 3.0);
    EXPECT_EQ(wire.state(), DriverState::holding); // it is not taken for one that stands for good
    wire.session.resume(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.grbl.moving(); }, 2.0));
    EXPECT_EQ(wire.state(), DriverState::running);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 30.0));
    EXPECT_NEAR(wire.grbl.position()[0], 50.0, 0.01);
}

TEST(GrblSession, AnEmergencyStopCutsOffWhatItFoundMoving) {
    GrblWire wire;
    find_moving(wire);
    wire.session.emergency_stop(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::alarm; }, 5.0));
    wire.run_until([] { return false; }, 1.0);
    EXPECT_FALSE(wire.grbl.moving());
    EXPECT_NE(wire.session.status().position_doubt, "");
    wire.session.reset(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0));
    EXPECT_FALSE(wire.session.readout().settings.empty());
}

TEST(GrblSession, LeavesWhatItFoundMovingWhenTheLinkIsDropped) {
    GrblWire wire;
    find_moving(wire);
    wire.session.leave(wire.now);
    wire.run_until([] { return false; }, 0.5);
    EXPECT_TRUE(wire.grbl.moving());
}

TEST(GrblSession, SurvivesALimitSwitchWhileItIsBeingAsked) {
    GrblWire wire;
    wire.session = GrblSession();
    wire.session.opened(wire.now);
    wire.sent.clear();
    ASSERT_TRUE(wire.run_until([&] { return wire.sent.find("$$") != std::string::npos; }, 10.0));
    wire.grbl.raise_alarm(); // in the middle of the questions
    ASSERT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
    EXPECT_FALSE(wire.session.stranger());
    EXPECT_EQ(wire.state(), DriverState::alarm);
}

TEST(GrblSession, NoticesThatTheControllerWasReset) {
    GrblWire wire({.reset = 800});
    wire.start(zigzag_with_spindle(30));
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("was reset"));
}

TEST(GrblSession, IsNotResetWhileTheMachineMovesForSomebodyElse) {
    GrblWire wire;
    wire.grbl.raise_alarm();
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::alarm; }, 5.0));
    wire.grbl.receive("\x18$X\nG1 X100 F60\n");
    wire.run_until([] { return false; }, 2.0);
    ASSERT_TRUE(wire.grbl.moving());
    EXPECT_THROW(wire.session.reset(wire.now), Error);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_TRUE(wire.grbl.moving());
}

TEST(GrblSession, NoticesALostLink) {
    GrblWire wire({.disconnect = 800});
    wire.start(zigzag_with_spindle(30));
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("the link was lost"));
    EXPECT_THROW(wire.start("G0 X0\n"), Error);
}

TEST(GrblSession, RefusesAProgramThatIsNoneForGrbl) {
    GrblWire wire;
    for (const char* program : {"G0 X1\n$H\n", "G0 X1 !\n", "?\n", "G0 X1~\n", "G1 X\x84\n", "G0\x01\n"}) {
        EXPECT_THROW(wire.start(program), Error) << program;
    }
    EXPECT_THROW(wire.start(std::string(80, 'X') + "\n"), Error);
    EXPECT_EQ(wire.state(), DriverState::idle);
}

} // namespace
} // namespace millwright::drivers::grbl
