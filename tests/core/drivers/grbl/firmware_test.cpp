// grblHAL and FluidNC: how they are met, and driven with axes beyond X, Y and Z.
#include "core/drivers/grbl/firmware.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/drivers/grbl/codes.h"
#include "core/drivers/grbl/internal/axis_limits.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "core/jobs/program_check.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

emulators::GrblEmulatorOptions hal(std::string axes = "XYZAB") {
    return {.firmware = emulators::EmulatedFirmware::grblhal, .axes = std::move(axes)};
}

emulators::GrblEmulatorOptions fluid(std::string axes = "XYZAB") {
    return {.firmware = emulators::EmulatedFirmware::fluidnc, .axes = std::move(axes)};
}

/// Linked again, so that the session knows what was set since.
void link_anew(GrblWire& wire) {
    wire.session.opened(wire.now);
    wire.run_until([&] { return wire.session.greeted(); }, 10.0);
}

Jog turn(char letter, double deg, double deg_per_s, const GrblWire& wire, double dead_man = 0.0) {
    const std::string& axes = wire.session.readout().axes;
    Jog jog;
    jog.way = kinematics::AxisPositions::Zero(std::ssize(axes));
    jog.way[static_cast<Eigen::Index>(axes.find(letter))] = from_degrees(deg);
    jog.speed = from_degrees(deg_per_s);
    jog.dead_man = dead_man;
    return jog;
}

std::string five_axes(int lines) {
    std::string text = "G21 G90 G94\nG1 F3000\n";
    for (int n = 0; n < lines; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 10 : 0) + " A" + std::to_string(3 * n) + " B" +
                std::to_string(-n) + "\n";
    }
    return text + "M30\n";
}

int done_lines(const emulators::GrblEmulator& grbl) {
    const emulators::Truth truth = grbl.truth();
    return static_cast<int>(std::ranges::count_if(
        truth.lines, [](const emulators::TruthLine& line) { return line.executed >= 0.0; }));
}

TEST(GrblFirmware, IsReadFromItsGreeting) {
    using Who = GrblIdentity;
    EXPECT_EQ(read_greeting("Grbl 1.1h ['$' for help]"), (Who{GrblFirmware::grbl, "1.1h"}));
    EXPECT_EQ(read_greeting("GrblHAL 1.1f ['$' or '$HELP' for help]"), (Who{GrblFirmware::grblhal, "1.1f"}));
    EXPECT_EQ(read_greeting("Grbl 3.7 [FluidNC v3.7.12 (wifi+bt) '$' for help]"),
              (Who{GrblFirmware::fluidnc, "v3.7.12"}));
    for (const char* none : {"Grbl ",
                             "Grbl 1.1h",
                             "Grbl ['$' for help]",
                             "Grbl 1.1h ['$' for hell]",
                             "Smoothie",
                             "GrblHAL 1.1f",
                             "Grbl 3.7 [OtherNC v1 '$' for help]",
                             ""}) {
        EXPECT_EQ(read_greeting(none), std::nullopt) << none;
    }
    EXPECT_EQ(read_build("1.1f.20240817:my mill").build, "20240817");
    EXPECT_EQ(read_build("3.7 FluidNC v3.7.12:").identity, (Who{GrblFirmware::fluidnc, "v3.7.12"}));
    EXPECT_EQ(read_build("1.1h.20190825:").identity, std::nullopt);
}

TEST(GrblFirmware, GrblHalIsMetWithItsAxesAndBuffers) {
    const GrblWire wire({}, hal());
    const Readout& known = wire.session.readout();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(known.firmware, GrblFirmware::grblhal);
    EXPECT_EQ(known.version, "1.1f");
    EXPECT_EQ(known.build, "20240817");
    EXPECT_EQ(known.axes, "XYZAB");
    EXPECT_EQ(known.planner_blocks, 35);
    EXPECT_EQ(known.segment_blocks, 10);
    EXPECT_EQ(known.buffer_bytes, 1024);
    EXPECT_TRUE(known.line_numbers);
    EXPECT_EQ(known.named.at("302"), "192.168.5.1");
    EXPECT_EQ(wire.session.status().position.size(), 5);
    EXPECT_EQ(known.offsets.at("G54").size(), 5U);
}

TEST(GrblFirmware, FluidNcIsMetWithWhatItKeepsUnderNames) {
    const GrblWire wire({}, fluid());
    const Readout& known = wire.session.readout();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(known.firmware, GrblFirmware::fluidnc);
    EXPECT_EQ(known.version, "v3.7.12");
    EXPECT_EQ(known.axes, "XYZAB"); // it names none: by their order
    EXPECT_EQ(known.planner_blocks, 15);
    EXPECT_EQ(known.segment_blocks, 12);
    EXPECT_EQ(known.buffer_bytes, 128);
    EXPECT_EQ(known.settings.at(113), 3600.0);
}

/// A build for more axes reports them as grblHAL does, and is Grbl otherwise.
TEST(GrblFirmware, AGrblForMoreAxesIsOne) {
    const GrblWire wire({}, {.axes = "XYZA"});
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.session.readout().firmware, GrblFirmware::grbl);
    EXPECT_EQ(wire.session.readout().axes, "XYZA");
}

TEST(GrblFirmware, SomebodyElseIsQuoted) {
    GrblSession session;
    session.opened(0.0);
    session.receive("Smoothie\r\n", 0.1);
    for (double now = 0.1; now < 10.0 && !session.greeted(); now += 0.1) {
        session.tick(now);
    }
    ASSERT_TRUE(session.stranger());
    EXPECT_EQ(session.stranger()->message, "no Grbl controller answers at this port; received 'Smoothie'");
}

// On a computer that kept this program waiting for longer than a greeting takes, it found no Grbl.
TEST(GrblFirmware, IsWaitedForAfreshWhereThisProgramWasKeptFromItsWork) {
    GrblSession session;
    session.opened(0.0);
    session.tick(0.1);
    session.tick(10.0);
    EXPECT_FALSE(session.greeted()) << session.status().message;
    for (double now = 10.1; now < 20.0 && !session.greeted(); now += 0.1) {
        session.tick(now);
    }
    ASSERT_TRUE(session.stranger());
    EXPECT_EQ(session.stranger()->message, "no Grbl controller answers at this port");
}

TEST(GrblFirmware, RunsAProgramOfFiveAxesAndNeverClaimsMoreThanWasExecuted) {
    for (const bool is_hal : {true, false}) {
        GrblWire wire({}, is_hal ? hal() : fluid());
        wire.grbl.receive("$10=3\n");
        wire.run_until([] { return false; }, 0.2);
        wire.start(five_axes(60));
        int claimed = 0;
        while (wire.state() == DriverState::running) {
            wire.step();
            const int blocks = wire.session.status().executed_blocks;
            EXPECT_LE(blocks, done_lines(wire.grbl));
            claimed = wire.state() == DriverState::running ? std::max(claimed, blocks) : claimed;
        }
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
        EXPECT_GT(claimed, 15);
        EXPECT_EQ(wire.grbl.axis_position('A'), 177.0);
        EXPECT_NEAR(wire.session.status().position[3], from_degrees(177.0), 1e-4);
        EXPECT_NEAR(wire.session.status().position[4], from_degrees(-59.0), 1e-4);
        EXPECT_EQ(wire.grbl.truth().lost_bytes, 0);
    }
}

TEST(GrblFirmware, SetsZeroOfARotaryAxis) {
    for (const auto& options : {hal("XYZA"), fluid("XYZA"), emulators::GrblEmulatorOptions{.axes = "XYZA"}}) {
        GrblWire wire({}, options);
        (void)wire.session.command(command_lines("G0 A90\nG10 L20 P0 A0"), wire.now);
        wire.run_to_end();
        wire.run_until([] { return false; }, 1.0);
        EXPECT_NEAR(wire.session.status().work_position()[3], 0.0, 1e-9);
        EXPECT_NEAR(wire.session.status().position[3], from_degrees(90.0), 1e-6);
        EXPECT_EQ(wire.session.readout().offsets.at("G54")[3], 90.0);
    }
}

TEST(GrblFirmware, JogsARotaryAxisAsFarAndAsFastAsItSays) {
    for (const auto& options : {hal("XYZA"), fluid("XYZA")}) {
        GrblWire wire({}, options);
        wire.session.jog(turn('A', 30.0, 20.0, wire), wire.now);
        const double begin = wire.grbl.time();
        EXPECT_EQ(wire.session.status().activity, Activity::jog);
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 20.0));
        EXPECT_NEAR(wire.grbl.axis_position('A'), 30.0, 0.01);
        EXPECT_NEAR(wire.grbl.truth().last_motion - begin, 30.0 / 20.0, 0.3);
        EXPECT_EQ(wire.grbl.position()[0], 0.0);
        Jog too_many = turn('A', 1.0, 1.0, wire);
        too_many.way = kinematics::AxisPositions::Ones(5);
        EXPECT_THROW(wire.session.jog(too_many, wire.now), Error);
    }
}

/// A grblHAL throws its receive buffer away when a jog is cancelled: lines in it are never answered. A
/// FluidNC refuses them.
TEST(GrblFirmware, AJogThatIsLetGoLeavesTheMachineReady) {
    for (const auto& options : {hal("XYZA"), fluid("XYZA")}) {
        for (int moment = 0; moment < 40; ++moment) {
            GrblWire wire({}, options);
            wire.session.jog(turn('A', 300.0, 60.0, wire, 5.0), wire.now);
            wire.run_until([] { return false; }, 0.3 + 0.005 * moment);
            wire.session.stop_jog(wire.now);
            ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 4.0)) << moment;
            EXPECT_THAT(wire.session.status().message, IsEmpty());
            wire.start("G0 A0\n");
            EXPECT_TRUE(wire.run_to_end());
            EXPECT_EQ(wire.state(), DriverState::idle) << moment << ": " << wire.session.status().message;
            EXPECT_EQ(wire.grbl.axis_position('A'), 0.0);
        }
    }
}

/// A grblHAL refuses all G-code with the error of a refused line until a $ line was right.
TEST(GrblFirmware, ARefusedJogDoesNotRefuseTheNextProgram) {
    GrblWire wire({}, hal("XYZA"), {}, "$22=1\n$20=1\n");
    link_anew(wire);
    Jog beyond = turn('A', 1.0, 1.0, wire);
    beyond.way = kinematics::AxisPositions::Zero(4);
    beyond.way[0] = 5.0; // machine coordinates end at 0
    beyond.speed = 10.0;
    wire.session.jog(beyond, wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 5.0));
    EXPECT_THAT(wire.session.status().message, HasSubstr("error 15"));
    wire.start("G0 X-1\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.grbl.position()[0], -1.0);
}

TEST(GrblFirmware, AGrblHalThatHasToBeHomedSaysSoAndIsHomed) {
    GrblWire wire({}, hal("XYZA"), {}, "$130=20\n$131=20\n$132=20\n$25=3000\n$24=600\n$22=5\n");
    wire.grbl.power_cycle();
    link_anew(wire);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("alarm 11: the machine must be homed"));
    EXPECT_FALSE(wire.session.stranger());
    wire.session.reset(wire.now);
    wire.run_until([&] { return wire.session.greeted(); }, 10.0);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("remains locked, error 46"));
    wire.session.home(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 60.0))
        << wire.session.status().message;
}

/// With RT- the characters ? ! ~ are text in $ lines; nothing that must act at once may depend on them.
TEST(GrblFirmware, AGrblHalWithoutPrintableRealtimeIsHeldAndStopped) {
    emulators::GrblEmulatorOptions options = hal("XYZA");
    options.printable_realtime = false;
    GrblWire wire({}, options);
    ASSERT_EQ(wire.state(), DriverState::idle);
    EXPECT_FALSE(wire.session.readout().printable_realtime);
    wire.sent.clear();
    wire.start("G21 G90\nG1 A360 F600\nG1 A0\n");
    wire.run_until([&] { return wire.grbl.axis_position('A') > 5.0; }, 10.0);
    wire.session.hold(wire.now);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.state(), DriverState::holding);
    EXPECT_FALSE(wire.grbl.moving());
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_TRUE(wire.grbl.moving());
    wire.session.stop(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::stopped) << wire.session.status().message;
    EXPECT_EQ(wire.sent.find_first_of("?!~"), std::string::npos);
}

TEST(GrblFirmware, AToolChangeWaitsForAPerson) {
    GrblWire wire({}, hal("XYZA"));
    (void)wire.session.command(command_lines("T2 M6\nG0 X1"), wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 5.0));
    EXPECT_THAT(wire.session.status().message, HasSubstr("requests another tool"));
    wire.session.resume(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.grbl.position()[0], 1.0);
}

TEST(GrblFirmware, FieldsThatGrblDoesNotSendAreGarbageFromGrblAlone) {
    constexpr std::string_view report = "<Run|MPos:0.000,0.000,0.000|Sc:XY|MPG:1|TLR:0|SD:12.5,job.nc>\r\n";
    for (const bool is_hal : {true, false}) {
        GrblWire wire({}, is_hal ? hal("XYZ") : emulators::GrblEmulatorOptions{});
        wire.start("G1 X100 F600\n");
        wire.run_until([] { return false; }, 0.5);
        wire.session.receive(report, wire.now);
        wire.run_until([] { return false; }, 0.3);
        EXPECT_EQ(wire.state() == DriverState::running, is_hal);
    }
}

// It was refused as a real-time command, by the first byte of the mark.
TEST(GrblFirmware, IsNotSentWhatIsNoPlainText) {
    using namespace std::string_literals;
    const auto refusal = [](const std::string& text) {
        try {
            (void)program_lines(test::listing_of(text), "part.nc");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return std::string();
    };
    EXPECT_EQ(refusal("\xFF\xFEG\0002\0001\0\n\0"s),
              "part.nc:1:1: the file is UTF-16 (save it as plain text)");
    EXPECT_EQ(refusal("G\0\0\0002\0\0\0\n\0\0\0"s),
              "part.nc:1:1: the file is UTF-32 (save it as plain text)");
    EXPECT_THAT(refusal("G21\nG0 X1\0\nM2\n"s), HasSubstr("part.nc:2:6: byte 0x00 found"));
    EXPECT_EQ(refusal("G21\nG0 X1\nM2\n"), "");
}

TEST(GrblFirmware, LimitsAreThoseOfItsSettings) {
    GrblWire wire({}, hal("XYZAB"), {}, "$22=1\n$130=300\n$134=90\n$376=1\n");
    link_anew(wire);
    const MachineLimits limits = machine_limits(wire.session.readout());
    ASSERT_EQ(limits.axes.size(), 5U);
    EXPECT_EQ(limits.axes[0].min, -300.0);
    EXPECT_EQ(limits.axes[0].max, 0.0);
    EXPECT_NEAR(*limits.axes[3].speed, from_degrees(60.0), 1e-9);
    EXPECT_FALSE(limits.axes[3].min || limits.axes[3].travel); // $133=0: without end
    EXPECT_FALSE(limits.axes[4].min);                          // it does not home
    EXPECT_THAT(
        setup_remarks(wire.session.readout()),
        ElementsAre(HasSubstr("Setting $376 does not mark B as rotary"), HasSubstr("B does not home")));
    GrblWire fluidnc({}, fluid("XYZA"), {}, "$/axes/x/max_travel_mm=250\n$/axes/x/homing/cycle=1\n");
    link_anew(fluidnc);
    const MachineLimits by_name = machine_limits(fluidnc.session.readout());
    EXPECT_EQ(by_name.axes[0].min, -250.0);
    EXPECT_EQ(by_name.axes[0].max, 0.0);
    EXPECT_NEAR(*by_name.axes[3].speed, from_degrees(60.0), 1e-9);
}

/// A grblHAL that takes A for a length moves it 25.4 times as far in inches.
TEST(GrblFirmware, WarnsOfAnAxisThatIsTakenForALength) {
    GrblWire wire({}, hal("XYZA"));
    EXPECT_THAT(setup_remarks(wire.session.readout()), Contains(HasSubstr("does not mark A as rotary")));
    (void)wire.session.command(command_lines("G20\nG0 A1"), wire.now);
    wire.run_to_end();
    EXPECT_NEAR(wire.grbl.axis_position('A'), 25.4, 0.01);
    test::store_settings(wire.grbl, "$376=1\n");
    link_anew(wire);
    EXPECT_THAT(setup_remarks(wire.session.readout()), IsEmpty());
}

TEST(GrblFirmware, ModesThatNoCheckFollowsAreFound) {
    EXPECT_EQ(unfollowed_mode("G0 G54 G17 G21 G90 G94 G49 G98 G50 M5"), "");
    EXPECT_EQ(unfollowed_mode("G0 G54 G17 G21 G90 G94 G49 G98 G51:XY M5"), "G51");
    EXPECT_EQ(unfollowed_mode("G0 G54 G7 G17"), "G7");
}

TEST(GrblFirmware, ErrorsAndAlarmsAreThoseOfTheFirmware) {
    EXPECT_THAT(explain_grbl_error(46, GrblFirmware::grblhal), HasSubstr("must be homed"));
    EXPECT_THAT(explain_grbl_error(46), HasSubstr("Grbl 1.1 does not define"));
    EXPECT_THAT(explain_grbl_error(250, GrblFirmware::fluidnc),
                HasSubstr("is unknown to Millwright for FluidNC"));
    EXPECT_THAT(explain_grbl_error(22, GrblFirmware::fluidnc), HasSubstr("the feed rate is not set"));
    EXPECT_THAT(explain_grbl_alarm(10, GrblFirmware::grblhal), HasSubstr("emergency stop"));
    EXPECT_THAT(explain_grbl_alarm(10, GrblFirmware::fluidnc), HasSubstr("spindle"));
    for (const GrblFirmware firmware : {GrblFirmware::grblhal, GrblFirmware::fluidnc}) {
        EXPECT_TRUE(std::ranges::is_sorted(grbl_errors(firmware), {}, &GrblCode::number));
        EXPECT_GT(grbl_errors(firmware).size(), grbl_errors().size());
        EXPECT_TRUE(grbl_alarm_loses_position(1, firmware));
    }
}

TEST(GrblFirmware, AProgramForAxesThatTheMachineLacksIsRefused) {
    const auto found = [](std::vector<program::ProgramAxis> axes) {
        return jobs::check_program(
            "G21 G90\nG0 X1 A90 B10\nM30\n",
            "five.ngc",
            {.dialect = gcode::Dialect::grbl, .axes = std::move(axes), .start = {}, .offsets = {}});
    };
    using kinematics::AxisKind;
    const std::vector<program::ProgramAxis> four = {
        {'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}, {'A', AxisKind::rotary}};
    ASSERT_THAT(found(four).errors, Not(IsEmpty()));
    EXPECT_EQ(found(four).errors.front().message,
              "the program moves B, but the machine has only X, Y, Z and A");
    EXPECT_EQ(found(four).errors.size(), 1U);
    std::vector<program::ProgramAxis> five = four;
    five.push_back({'B', AxisKind::rotary});
    EXPECT_THAT(found(five).errors, IsEmpty());
    EXPECT_NEAR(found(five).ranges[3].max, from_degrees(90.0), 1e-9);
    EXPECT_THAT(found({}).errors.front().message, HasSubstr("axes XYZ"));
}

} // namespace
} // namespace millwright::drivers::grbl
