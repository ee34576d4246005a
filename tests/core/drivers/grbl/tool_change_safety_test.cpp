// Tool changes where something is not as it was meant: zeros that move, holds, doors, lengths left behind.
#include "core/base/error.h"
#include "tests/core/drivers/grbl/tool_change_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::drivers::grbl {
namespace {

using test::Bench;
using test::probe_plan;
using test::three_tools;
using test::ToolChangeWire;
using testing::HasSubstr;
using testing::Not;

const std::string change_at_seven =
    "G21 G90 G94\nG0 Z5\nM3 S1000\nG1 Z-1 F600\nX10\nG0 Z8\nT3 M6\nX20\nG0 Z5\nM30\n";
/// Its first tool is in the spindle before it begins.
const std::string second_tool_alone =
    "G21 G90 G94\nG0 Z5\nX10\nG1 Z1 F500\nG0 Z5\nT2 M6\nX20\nG1 Z1\nG0 Z5\nM30\n";
const ToolChangePlan waiting_plan{.way = ToolChangeWay::stop, .spin_up = 0.0};

std::string refusal_of(const std::function<void()>& asked) {
    try {
        asked();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

void go_on_to_next_change(ToolChangeWire& wire) {
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.waits(); }, 5.0);
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
}

TEST(GrblToolSafety, AZeroThatIsSetForAMeasuredToolIsNotCountedTwice) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    EXPECT_FALSE(wire.session.status().tool_change->keeps_zero);
    EXPECT_THAT(wire.session.status().message, HasSubstr("which is the reference"));
    go_on_to_next_change(wire);
    EXPECT_TRUE(wire.session.status().tool_change->keeps_zero);
    EXPECT_THAT(wire.session.status().message, HasSubstr("do not change the Z zero"));
    wire.longer = -10.0;
    wire.jog({0.0, 0.0, -15.0});
    wire.command("G10 L20 P0 Z0");
    wire.sent.clear();
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 5.0);
    EXPECT_TRUE(wire.waits());
    EXPECT_EQ(wire.sent_lines(), "");
    EXPECT_THAT(wire.session.status().message, HasSubstr("Z of G54 was -50.000 and is now -60.000"));
    wire.command("G10 L2 P1 Z-50");
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.session.status().tool_change; }, 120.0);
    double lowest = 0.0;
    for (const auto& place : wire.path_while([&] { return !wire.waits() && !wire.ended(); })) {
        lowest = std::min(lowest, place[2]);
    }
    EXPECT_NEAR(lowest, -59.0, 0.02);
}

TEST(GrblToolSafety, TheReferenceIsNotMeasuredWithALengthInForce) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.command("G43.1 Z3");
    wire.sent.clear();
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 3.0);
    EXPECT_EQ(wire.sent_lines(), "");
    EXPECT_THAT(wire.session.status().message, HasSubstr("cancel it with G49"));
}

TEST(GrblToolSafety, AfterAMacroWithNoKnownHeightTheMachineStays) {
    Bench wire;
    wire.command("G53 G0 Z-49.5");
    ToolChangePlan plan = waiting_plan;
    plan.way = ToolChangeWay::macro;
    plan.macro = "G53 G0 Z-2\nG53 G0 X-10 Y-290\nG53 G0 Z-40\n";
    wire.begin("G21 G90 G94\nT1 M6\nM3 S500\nG0 Z5\nX10\nM30\n", plan);
    ASSERT_TRUE(wire.run_to_change());
    EXPECT_THAT(wire.session.status().message, HasSubstr("no safe height is known yet"));
    wire.sent.clear();
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.session.status().tool_change; }, 60.0);
    EXPECT_THAT(wire.sent_lines(), Not(HasSubstr("G53G0X-150")));
    EXPECT_NEAR(wire.grbl.position()[0], -10.0, 0.001);
    EXPECT_NEAR(wire.grbl.position()[1], -290.0, 0.001);
    EXPECT_THAT(wire.session.status().own_lines,
                testing::Contains(HasSubstr("the machine stays where it is")));
}

TEST(GrblToolSafety, AMachineThatWasNotHomedIsNotHomedInTheMiddle) {
    ToolChangeWire wire;
    wire.command("$22=1");
    wire.begin(change_at_seven, waiting_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.sent.clear();
    EXPECT_THAT(refusal_of([&] { wire.session.home(wire.now); }), HasSubstr("not homed before the job"));
    wire.run_until([] { return false; }, 2.0);
    EXPECT_EQ(wire.sent_lines(), "");
    EXPECT_TRUE(wire.waits());

    Bench homed;
    homed.begin(second_tool_alone, waiting_plan);
    ASSERT_TRUE(homed.run_to_change());
    const auto there = homed.grbl.position();
    homed.session.home(homed.now);
    homed.run_until([&] { return homed.waits() && homed.grbl.position()[2] > -1.5; }, 120.0);
    homed.session.resume(homed.now);
    const auto back = homed.path_while([&] { return homed.session.status().tool_change.has_value(); });
    EXPECT_GE(ToolChangeWire::lowest_across(back), -2.0);
    EXPECT_NEAR(homed.grbl.position()[0], there[0], 0.001);
    EXPECT_NEAR(homed.grbl.position()[2], there[2], 0.001);
}

TEST(GrblToolSafety, TheLastToolOfAJobIsNotTheReferenceOfTheNext) {
    Bench wire;
    wire.begin(second_tool_alone, probe_plan);
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
    wire.longer = 8.0;
    wire.session.resume(wire.now);
    wire.run_to_end();
    ASSERT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    wire.sent.clear();
    EXPECT_THAT(refusal_of([&] { wire.begin(second_tool_alone, probe_plan); }),
                HasSubstr("it belongs to another tool"));
    wire.run_until([] { return false; }, 2.0);
    EXPECT_EQ(wire.sent_lines(), "");
    wire.command("G10 L20 P1 Z-3");
    wire.begin(second_tool_alone, probe_plan);
    EXPECT_TRUE(wire.run_to_change()) << wire.session.status().message;
}

/// Also where the job ended while it waited: whatever was put in.
TEST(GrblToolSafety, AToolThatWasPutInBeforeAStopIsNoReference) {
    Bench wire;
    wire.begin(second_tool_alone, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.session.stop(wire.now);
    wire.run_to_end();
    EXPECT_THAT(refusal_of([&] { wire.begin(second_tool_alone, probe_plan); }),
                HasSubstr("it belongs to another tool"));
}

TEST(GrblToolSafety, GoingOnAfterAHoldIsNotGoingOnWithTheChange) {
    for (const bool jogs : {false, true}) {
        ToolChangeWire wire;
        wire.begin(change_at_seven, waiting_plan);
        ASSERT_TRUE(wire.run_to_change());
        if (jogs) {
            wire.session.jog({kinematics::AxisPositions(Vec3(-40.0, 0.0, 0.0)), 10.0, 0.0}, wire.now);
            wire.run_until([] { return false; }, 0.5);
        }
        wire.session.hold(wire.now);
        wire.run_until([] { return false; }, 3.0);
        EXPECT_TRUE(wire.session.status().tool_change->held);
        EXPECT_THAT(wire.session.status().message, HasSubstr("on hold"));
        const auto there = wire.grbl.position();
        wire.sent.clear();
        wire.session.resume(wire.now);
        wire.run_until([] { return false; }, 3.0);
        EXPECT_EQ(wire.sent_lines(), "");
        EXPECT_EQ(wire.grbl.position(), there);
        EXPECT_TRUE(wire.waits());
        wire.session.resume(wire.now);
        EXPECT_TRUE(wire.run_to_end());
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    }
}

TEST(GrblToolSafety, ADoorThatIsOpenWhileItWaitsKeepsEverythingBack) {
    ToolChangeWire wire;
    wire.begin(change_at_seven, waiting_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.grbl.set_door(true);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.state(), DriverState::holding);
    EXPECT_THAT(wire.session.status().message, HasSubstr("door is open"));
    wire.sent.clear();
    const Jog way{kinematics::AxisPositions(Vec3(-5.0, 0.0, 0.0)), 10.0, 0.0};
    EXPECT_THAT(refusal_of([&] { wire.session.jog(way, wire.now); }), HasSubstr("door is open"));
    EXPECT_THAT(refusal_of([&] { (void)wire.session.command(command_lines("G0 X1"), wire.now); }),
                HasSubstr("door is open"));
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.sent_lines(), "~");
    wire.grbl.set_door(false);
    wire.run_until([] { return false; }, 1.0);
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 2.0);
    EXPECT_THAT(wire.sent_lines(), Not(HasSubstr("G"))) << "that was for the door";
    EXPECT_TRUE(wire.waits());
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
}

TEST(GrblToolSafety, AHoldAtTheMachineIsShownAndEndedAtEveryMoment) {
    int held = 0;
    for (int moment = 0; moment < 40; ++moment) {
        ToolChangeWire wire;
        wire.begin(change_at_seven, waiting_plan);
        wire.run_until([&] { return wire.session.status().tool_change.has_value(); }, 60.0);
        wire.run_until([] { return false; }, 0.01 * moment);
        if (!wire.session.status().tool_change || wire.waits()) {
            continue;
        }
        wire.grbl.receive("!");
        wire.run_until([] { return false; }, 1.5);
        const bool rests = wire.waits() && wire.session.status().message.find("hold") == std::string::npos;
        if (rests) { // it was at rest: there was nothing to hold
            continue;
        }
        EXPECT_EQ(wire.state(), DriverState::holding) << moment;
        EXPECT_THAT(wire.session.status().message, HasSubstr("hold was pressed")) << moment;
        wire.session.resume(wire.now);
        ASSERT_TRUE(wire.run_to_change()) << moment;
        wire.run_until([] { return false; }, 2.0);
        EXPECT_TRUE(wire.waits()) << moment << ": the tool change is not confirmed";
        wire.session.resume(wire.now);
        EXPECT_TRUE(wire.run_to_end()) << moment;
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
        ++held;
    }
    EXPECT_GT(held, 3);
}

/// A grblHAL keeps a length over a reset.
TEST(GrblToolSafety, NoProgramRunsWithTheLengthThatAJobLeft) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    go_on_to_next_change(wire);
    wire.longer = 4.0;
    go_on_to_next_change(wire);
    wire.session.emergency_stop(wire.now);
    wire.run_until([] { return false; }, 3.0);
    EXPECT_THAT(wire.session.status().own_lines.back(), HasSubstr("no job starts until it is cancelled"));
    wire.on_the_way = [](std::string& bytes) {
        if (const std::size_t at = bytes.find("$I\n"); at != std::string::npos) {
            bytes.replace(at, 3, "G43.1Z4\n");
        }
    };
    wire.session.reset(wire.now);
    wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0);
    wire.on_the_way = {};
    ASSERT_EQ(wire.session.readout().offsets.at("TLO")[2], 4.0);
    EXPECT_THAT(refusal_of([&] { wire.start("G0 X1\n"); }), HasSubstr("of an earlier job is still active"));
    wire.command("G49");
    EXPECT_EQ(refusal_of([&] { wire.start("G53 G0 Z-1\n"); }), "");
}

TEST(GrblToolSafety, ALengthThatAPersonSetsEndsWithTheJob) {
    ToolChangeWire wire;
    wire.begin(change_at_seven, waiting_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.command("G43.1 Z3");
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.session.readout().offsets.at("TLO")[2], 0.0);
    EXPECT_EQ(wire.session.status().own_lines.back(), "G49");
}

TEST(GrblToolSafety, SpindleAndCoolantOfThePersonAreOffBeforeAnythingMoves) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.command("M3 S500");
    wire.command("M8");
    wire.sent.clear();
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.session.status().tool_change; }, 120.0);
    EXPECT_THAT(wire.sent_lines(), testing::StartsWith("M5\nM9\nG21G90G94\nG53G0Z"));
    wire.run_until([] { return false; }, 0.5);
    EXPECT_FALSE(wire.session.status().coolant.flood);
    EXPECT_EQ(wire.session.status().spindle, gcode::SpindleTurning::stopped);
}

TEST(GrblToolSafety, ToolsTooLongForTheHeightOfTheProgramWaitOn) {
    Bench wire;
    wire.begin("G21 G90 G94\nT1 M6\nG0 Z30\nX10\nG1 Z1 F500\nG0 Z15\nT2 M6\nX20\nM30\n", probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    go_on_to_next_change(wire);
    wire.longer = 30.0;
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.waits(); }, 5.0);
    ASSERT_TRUE(wire.run_to_change());
    EXPECT_THAT(wire.session.status().message, HasSubstr("10.000 mm above the Z travel"));
    EXPECT_NEAR(wire.grbl.position()[0], -10.0, 0.01) << "it stays over the sensor";
    wire.longer = 5.0;
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
}

/// Over what a person has driven around, as clamps.
TEST(GrblToolSafety, TheWayBackIsNotLowerThanThePersonWas) {
    ToolChangeWire wire;
    wire.begin(change_at_seven, waiting_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.jog({0.0, 0.0, 22.0});
    wire.jog({-40.0, 0.0, 0.0});
    wire.jog({0.0, 0.0, -25.0});
    wire.session.resume(wire.now);
    const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    EXPECT_GE(ToolChangeWire::lowest_across(path), 29.9);
}

TEST(GrblToolSafety, AChangeThatIsNotReadRefusesTheProgram) {
    ToolChangeWire wire;
    EXPECT_THAT(refusal_of([&] { wire.begin("G21 G90\nG0 Z5\nT2 M6\nM0 6\n", waiting_plan); }),
                HasSubstr("at line 4 is written in an unsupported way"));
    EXPECT_EQ(wire.state(), DriverState::idle);
}

} // namespace
} // namespace millwright::drivers::grbl
