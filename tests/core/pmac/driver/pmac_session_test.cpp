// The driver against the emulated card: P1, P8, F2 to F4, in computed time.
#include "core/base/files.h"
#include "core/pmac/driver/pmac_file.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::long_x_feed;
using test::PmacWire;
using test::refusal;
using testing::HasSubstr;

const std::vector<std::string> program_one{
    "INC", "TA20", "TS10", "LINEAR", "FRAX(X,Y,Z,A)", "X10 Y10 Z10 A10 F0.5"};

TEST(PmacSession, GreetsTheCardInWhateverModeItIs) {
    for (const char* const mode : {"I3=0", "I3=1 I6=3", "I3=2", "I3=3 I4=1", "I9=3"}) {
        PmacWire wire({}, false);
        wire.session.closed();
        wire.card.receive(std::string(mode) + "\r");
        wire.session.opened(wire.now);
        wire.run_until([&] { return wire.session.greeted(); }, 10.0);
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << mode << wire.session.status().message;
    }
}

TEST(PmacSession, ACardThatRepeatsWhatItIsSentIsToldNotTo) {
    const PmacWire wire({}, true, "XYZA", {}, "\x14");
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_TRUE(wire.session.position_known());
}

TEST(PmacSession, TellsSilenceFromHalfAnAnswer) {
    for (const std::string heard : {"", "PMA"}) {
        PmacSession session(arm_settings());
        session.opened(0.0);
        double now = 0.0;
        for (; session.status().state != drivers::DriverState::alarm && now < 60.0; now += 0.01) {
            session.tick(now);
            if (session.take_output().find("TYPE") != std::string::npos) {
                session.receive(heard, now);
            }
        }
        EXPECT_LT(now, 30.0);
        EXPECT_THAT(session.status().message,
                    HasSubstr(heard.empty() ? "no PMAC answers" : "the device that answers is not a PMAC"));
    }
}

TEST(PmacSession, ALinkThatIsLostBeforeTheCardAnsweredIsToldAsThatAlone) {
    PmacSession session(arm_settings());
    session.opened(0.0);
    session.lost("the port is held by another client, 127.0.0.1:5");
    const auto why = session.stranger();
    ASSERT_TRUE(why);
    EXPECT_EQ(to_text(*why), "the port is held by another client, 127.0.0.1:5");
}

// Loaded with settings of five axes, and connected with four.
TEST(PmacSession, AProgramThatAnOpenLoopRefusesNamesItsMotor) {
    std::string axis_5;
    const std::string sample = "assets/samples/pmac-axis-5.ini";
    for (const auto& line : read_pmac_file(read_file(sample), sample).lines) {
        axis_5 += line.text + "\n";
    }
    PmacWire wire({}, true, "XYZA", {}, axis_5);
    ASSERT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    wire.session.start(program_one, wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() != drivers::DriverState::running; }, 10.0));
    EXPECT_THAT(wire.session.status().message, HasSubstr("ERR012, a motor is in open loop; "));
    EXPECT_THAT(
        wire.session.status().message,
        HasSubstr("also motor 5 (71.1111B), which is not driven here: connect with its axis (\"Axis 5\", "
                  "--axes XYZAB), or load settings without it"));
    EXPECT_EQ(wire.card.command(1), 0.0);
}

/// The same of a line that a person types, as `millwright pmac` and the terminal send it.
TEST(PmacSession, ATypedRunThatAnOpenLoopRefusesNamesItsMotorToo) {
    std::string axis_5;
    const std::string sample = "assets/samples/pmac-axis-5.ini";
    for (const auto& line : read_pmac_file(read_file(sample), sample).lines) {
        axis_5 += line.text + "\n";
    }
    PmacWire wire({}, true, "XYZA", {}, axis_5);
    const auto answer_to = [&wire](const std::vector<std::string>& lines) {
        (void)wire.session.command(lines, false);
        wire.run_until(
            [&] { return wire.session.status().answer.state != drivers::CommandAnswer::State::pending; },
            5.0);
        return wire.session.status().answer;
    };
    ASSERT_EQ(answer_to({"OPEN PROG 1", "CLEAR", "LINEAR", "TM500", "X1", "CLOSE"}).state,
              drivers::CommandAnswer::State::done);
    const drivers::CommandAnswer answer = answer_to({"&1B1R"});
    EXPECT_EQ(answer.state, drivers::CommandAnswer::State::refused);
    EXPECT_THAT(answer.text, HasSubstr("ERR012, a motor is in open loop; "));
    EXPECT_THAT(answer.text, HasSubstr("also motor 5 (71.1111B), which is not driven here"));
    EXPECT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 5.0))
        << wire.session.status().message;
}

TEST(PmacSession, KnowsNoPositionBeforeHoming) {
    PmacWire wire({}, false);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    EXPECT_FALSE(wire.session.position_known());
    EXPECT_FALSE(wire.session.enabled());
    EXPECT_FALSE(wire.session.status().position_known);
    EXPECT_EQ(wire.session.status().message, "");
    EXPECT_THAT(refusal([&] { wire.session.start(program_one, wire.now); }), HasSubstr("not enabled"));
    wire.session.enable(wire.now);
    wire.run_until([&] { return wire.session.enabled(); }, 2.0);
    EXPECT_TRUE(wire.session.enabled());
    EXPECT_THAT(refusal([&] { wire.session.start(program_one, wire.now); }), HasSubstr("is unknown"));
    wire.session.home(wire.now);
    EXPECT_TRUE(wire.run_until([&] { return wire.state() != drivers::DriverState::running; }, 60.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_TRUE(wire.session.position_known());
    EXPECT_NEAR(wire.card.position(3), 0.0, 0.5);
}

TEST(PmacSessionP8, RunsTheThesisProgramToItsCounts) {
    PmacWire wire;
    wire.session.start(program_one, wire.now);
    EXPECT_EQ(wire.state(), drivers::DriverState::running);
    EXPECT_EQ(wire.session.status().activity, drivers::Activity::program);
    wire.pass(30.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::running) << wire.session.status().message;
    EXPECT_LT(wire.session.status().executed_blocks, 6);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().executed_blocks, 6);
    wire.pass(0.5);
    EXPECT_NEAR(wire.card.position(1), 1200.0, 0.06);
    EXPECT_NEAR(wire.card.position(2), 2220.0, 0.06);
    EXPECT_NEAR(wire.session.status().position[3], from_degrees(10.0), 1e-5);
}

/// A fifth axis on a second row of outputs, and one that the card simulates.
struct Fifth {
    const char* name;
    int channels;
    const char* setup;
};

class PmacSessionP12 : public testing::TestWithParam<Fifth> {};

TEST_P(PmacSessionP12, JogsAndRunsAFifthAxis) {
    PmacWire wire({}, true, "XYZAB", {.plants = {}, .channels = GetParam().channels}, GetParam().setup);
    ASSERT_TRUE(wire.session.position_known()) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().position.size(), 5);
    drivers::Jog jog = jog_of(0, 0.0, 5.0);
    jog.way = kinematics::AxisPositions::Zero(5);
    jog.way[4] = from_degrees(10.0);
    wire.session.jog(jog, wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    wire.pass(0.5);
    EXPECT_NEAR(wire.degrees(4), 10.0, 0.02);
    EXPECT_NEAR(wire.session.status().position[4], from_degrees(10.0), 1e-3);
    jog.way[4] = from_degrees(85.0);
    EXPECT_THAT(refusal([&] { wire.session.jog(jog, wire.now); }), HasSubstr("B would exceed its limits"));
    wire.session.start({"ABS", "LINEAR", "TM2000", "X5 B-20"}, wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    wire.pass(0.5);
    EXPECT_NEAR(wire.degrees(4), -20.0, 0.02);
    EXPECT_NEAR(wire.degrees(0), 5.0, 0.02);
    wire.session.emergency_stop(wire.now);
    wire.pass(0.2);
    EXPECT_FALSE(wire.card.enabled(5));
}

INSTANTIATE_TEST_SUITE_P(
    Ways,
    PmacSessionP12,
    testing::Values(Fifth{"second_row", 8, "I500=1\nI922=10\n#5->71.1111B\n"},
                    Fifth{"simulated", 4, "WY:$724,$5007F0\nI500=1\nI502=$7F0\nI503=$724\n#5->71.1111B\n"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(PmacSession, ClaimsNoMoreLinesThanWereExecuted) {
    PmacWire wire;
    std::vector<std::string> lines{"INC", "FRAX(X,Y)", "LINEAR TM300"}; // brackets make no loop
    for (int n = 0; n < 12; ++n) {
        lines.push_back(n % 2 == 0 ? "X1" : "X(P9+1)");
    }
    wire.session.start(lines, wire.now);
    int most = 0;
    while (wire.state() == drivers::DriverState::running) {
        wire.step();
        const int claimed = std::max(0, wire.session.status().executed_blocks - 3);
        EXPECT_LE(claimed, wire.card.command(1) / 120.0 + 1e-6);
        most = std::max(most, claimed);
    }
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().executed_blocks, 15) << wire.session.status().message;
    EXPECT_GT(most, 6);
}

TEST(PmacSession, HoldsResumesAndStops) {
    PmacWire wire;
    wire.session.start(program_one, wire.now);
    wire.pass(8.0);
    wire.session.hold(wire.now);
    EXPECT_EQ(wire.state(), drivers::DriverState::holding);
    wire.pass(2.0);
    const double held = wire.card.command(1);
    wire.pass(1.0);
    EXPECT_EQ(wire.card.command(1), held);
    EXPECT_EQ(wire.state(), drivers::DriverState::holding) << wire.session.status().message;
    wire.session.resume(wire.now);
    wire.pass(2.0);
    EXPECT_GT(wire.card.command(1), held);
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_to_end(10.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped) << wire.session.status().message;
    EXPECT_TRUE(wire.powered());
    EXPECT_FALSE(wire.card.program_runs(1));
    const double stopped = wire.card.command(1);
    wire.pass(2.0);
    EXPECT_EQ(wire.card.command(1), stopped);
}

TEST(PmacSession, DoesNotTakeItsOwnHoldForSomebodyElsesWhenItResumes) {
    for (int n = 0; n < 20; ++n) {
        PmacWire wire;
        wire.session.start(program_one, wire.now);
        wire.pass(8.0);
        wire.session.hold(wire.now);
        wire.pass(2.0 + 0.003 * n); // whatever is being asked meanwhile
        wire.session.resume(wire.now);
        for (int step = 0; step < 200; ++step) {
            wire.step();
            ASSERT_EQ(wire.state(), drivers::DriverState::running) << n;
            ASSERT_EQ(wire.session.status().message, "") << n;
        }
    }
}

TEST(PmacSession, DoesNotTakeItsOwnPauseForTheCardsSilence) {
    for (int n = 0; n < 20; ++n) {
        PmacWire wire;
        wire.pass(0.5 + 0.003 * n);
        wire.now += 60.0; // what has come meanwhile is read a moment later
        wire.session.tick(wire.now);
        wire.pass(0.5);
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    }
}

TEST(PmacProgram, OfASessionIsStoppedAtASoftLimit) {
    PmacWire wire;
    wire.session.start({"INC", "LINEAR", "FRAX(X)", "F20", "X170"}, wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped) << wire.session.status().message;
    EXPECT_THAT(wire.session.status().message, HasSubstr("X is beyond its limit"));
    EXPECT_LT(wire.degrees(0), 115.0);
}

TEST(PmacSafetyF2, ALostLinkEndsMotionWithin100Milliseconds) {
    for (const bool jogging : {true, false}) {
        PmacWire wire;
        jogging ? wire.session.jog(jog_of(0, 80.0, 5.0, 5.0), wire.now)
                : wire.session.start(long_x_feed, wire.now);
        wire.pass(1.5);
        ASSERT_FALSE(wire.standing()) << wire.session.status().message;
        wire.cut();
        const double cut = wire.card.time();
        wire.run_until([&] { return !wire.powered(); }, 1.0);
        EXPECT_LE(wire.card.time() - cut, 0.100);
        wire.pass(0.3); // coasting
        EXPECT_TRUE(wire.standing());
        EXPECT_FALSE(wire.powered());
        EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
        EXPECT_TRUE(wire.session.link_lost());
        EXPECT_FALSE(wire.session.status().position_known); // it went on for a while
        wire.pass(5.0);
        EXPECT_TRUE(wire.standing());
    }
}

TEST(PmacSafetyF2, SilenceEndsMotionToo) {
    PmacWire wire;
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    wire.pass(1.0);
    ASSERT_FALSE(wire.standing());
    wire.go_deaf();
    const double deaf = wire.card.time();
    wire.run_until([&] { return !wire.powered(); }, 1.0);
    EXPECT_LE(wire.card.time() - deaf, 0.100);
    wire.pass(4.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("did not answer"));
}

/// As a busy computer does: the program has no other cause to end.
TEST(PmacSafetyF2, AnEndByTheCardsOwnWatchIsToldAsThat) {
    PmacWire wire;
    wire.session.start(long_x_feed, wire.now);
    wire.pass(1.5);
    ASSERT_FALSE(wire.standing());
    const double late = test::wire_settings().abort_after + 0.01;
    wire.step(late);
    ASSERT_TRUE(wire.run_to_end(5.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("received nothing from this computer for 50 ms"));
    wire.pass(1.0);
    EXPECT_TRUE(wire.standing());
}

TEST(PmacSafetyF2, AnEmergencyStopKillsAndNothingGivesPowerBack) {
    PmacWire wire;
    wire.session.start(long_x_feed, wire.now);
    wire.pass(1.5);
    ASSERT_FALSE(wire.standing());
    wire.session.emergency_stop(wire.now);
    wire.step();
    EXPECT_FALSE(wire.powered());
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    wire.pass(3.0);
    EXPECT_FALSE(wire.powered());
    EXPECT_NE(refusal([&] { wire.session.jog(jog_of(0, 1.0, 1.0), wire.now); }), "");
    wire.session.reset(wire.now);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    wire.pass(1.0);
    EXPECT_FALSE(wire.powered());
    EXPECT_THAT(refusal([&] { wire.session.jog(jog_of(0, 1.0, 1.0), wire.now); }), HasSubstr("not enabled"));
    EXPECT_THAT(refusal([&] { wire.session.home(wire.now); }), HasSubstr("not enabled"));
    wire.session.stop(wire.now);
    wire.session.hold(wire.now);
    wire.session.resume(wire.now);
    wire.session.stop_jog(wire.now);
    wire.pass(1.0);
    EXPECT_FALSE(wire.powered());
    wire.session.enable(wire.now); // a person's own decision
    wire.pass(0.5);
    EXPECT_TRUE(wire.powered());
    EXPECT_TRUE(wire.session.position_known());
}

TEST(PmacSafetyF2, FaultsOfTheMachineEndInAlarmWithoutPower) {
    for (const int kind : {0, 1, 2}) {
        PmacWire wire;
        wire.session.start(long_x_feed, wire.now);
        wire.pass(1.5);
        if (kind == 0) {
            wire.card.raise_alarm();
        } else if (kind == 1) {
            wire.card.unplug_encoder(1);
        } else {
            wire.card.power_cycle();
        }
        ASSERT_TRUE(wire.run_to_end(8.0)) << kind;
        EXPECT_EQ(wire.state(), drivers::DriverState::alarm) << kind;
        EXPECT_NE(wire.session.status().message, "");
        wire.card.clear_faults();
        wire.pass(1.0);
        EXPECT_TRUE(wire.standing()) << kind;
        EXPECT_FALSE(wire.powered()) << kind;
    }
}

TEST(PmacSession, ARefusedLineOfAProgramRunsNothing) {
    PmacWire wire;
    wire.session.start({"INC", "X10 F1", "NONSENSE(5"}, wire.now);
    ASSERT_TRUE(wire.run_to_end(5.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    EXPECT_THAT(wire.session.status().message, HasSubstr("NONSENSE(5"));
    wire.pass(1.0);
    EXPECT_EQ(wire.card.moves(1), 0);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
}

TEST(PmacDirectionF4, AJogAndAProgramGoTheSameWay) {
    for (const std::size_t axis : {0u, 1u, 2u, 3u}) {
        PmacWire wire;
        wire.session.jog(jog_of(static_cast<Eigen::Index>(axis), 1.0, 5.0), wire.now);
        ASSERT_TRUE(wire.run_to_end(10.0));
        wire.pass(0.3);
        EXPECT_NEAR(wire.degrees(axis), 1.0, 0.02);
        wire.session.start({"INC", "LINEAR", "FRAX(X,Y,Z,A)", "F5", std::string(1, "XYZA"[axis]) + "1"},
                           wire.now);
        ASSERT_TRUE(wire.run_to_end(10.0));
        wire.pass(0.3);
        EXPECT_NEAR(wire.degrees(axis), 2.0, 0.02) << wire.session.status().message;
    }
}

TEST(PmacSessionU3, TellsWhatEachMotorMayDoByTheCardsOwnVariables) {
    PmacWire wire;
    (void)wire.session.command({"I216=40", "I217=0.25", "I213=22200", "I214=-11100", "I313=0", "I269=3276"},
                               false);
    wire.pass(1.0);
    const auto limits = wire.session.limits();
    ASSERT_EQ(limits.size(), 4U);
    const auto& y = limits[1];
    EXPECT_EQ(y.letter, 'Y');
    EXPECT_NEAR(to_degrees(y.speed.value()), 40e3 / 222.0, 1e-9);
    EXPECT_NEAR(to_degrees(y.acceleration.value()), 0.25e6 / 222.0, 1e-9);
    EXPECT_NEAR(to_degrees(y.max.value()), 90.0, 1e-9); // the joint's own, which is narrower
    EXPECT_NEAR(to_degrees(y.min.value()), -50.0, 1e-9);
    EXPECT_NEAR(y.output_V.value(), 0.99976, 1e-5);
    EXPECT_NEAR(to_degrees(y.jog_speed.value()), 32e3 / 222.0, 1e-9); // the factory's
    EXPECT_NEAR(to_degrees(limits[2].max.value()), 90.0, 1e-9);       // 0 switches the card's off
}

TEST(PmacSessionU3, TellsFollowingErrorAndOutputTenTimesASecond) {
    PmacWire wire;
    (void)wire.session.command({"I130=500", "I131=0"}, false); // a soft motor lags
    wire.pass(0.5);
    wire.session.jog(jog_of(0, 20.0, 5.0), wire.now);
    wire.pass(1.0); // at speed
    const double before = wire.session.status().motors.at(0).following_error;
    EXPECT_NEAR(
        before, from_degrees((wire.card.command(1) - wire.card.position(1)) / 120.0), from_degrees(0.02));
    EXPECT_GT(before, from_degrees(0.1));
    EXPECT_NEAR(wire.session.status().motors.at(0).output_V, wire.card.output(1) * 10.0 / 32768.0, 0.02);
    EXPECT_GT(wire.card.output(1), 0.0);
    int changes = 0;
    double last = before;
    const double from = wire.now;
    while (wire.now < from + 1.0) { // to and fro, so that it changes all the time
        const double way = std::fmod(wire.now - from, 0.4) < 0.2 ? -5.0 : 5.0;
        wire.session.jog(jog_of(0, way, 5.0, 0.5), wire.now);
        wire.pass(0.02);
        const double now = wire.session.status().motors.at(0).following_error;
        changes += std::abs(now - last) > 0.0 ? 1 : 0;
        last = now;
    }
    EXPECT_GE(changes, 9);
}

TEST(PmacSessionU3, ACardThatKnowsNoConverterIsAskedNoMore) {
    MotorReadings readings(test::wire_settings().axes);
    EXPECT_EQ(readings.reading_line(), ""); // nothing is known of its outputs
    for (std::size_t n = 0; n < 4; ++n) {
        readings.read_rating(n, {"1", "$C003", "32000", "0", "0", "32", "0.5", "32", "10", "$C000", "20480"});
    }
    EXPECT_THAT(readings.reading_line(), HasSubstr("#4FRY$C003"));
    readings.read({"1", "garbled"});
    EXPECT_EQ(readings.reading_line(), "");
    EXPECT_TRUE(readings.motors().empty());
}

} // namespace
} // namespace millwright::pmac::internal
