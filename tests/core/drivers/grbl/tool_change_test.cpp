// Tool changes in the middle of a program: what is on the wire, and where the machine goes.
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

/// The change is at line 8, at X10 Z8.
const std::string two_tools = "(two tools)\nG21 G90 G94\nG0 Z5\nM3 S1000\nG1 Z-1 F600\nX10\nG0 Z8\n"
                              "T3 M6 (6 mm end mill)\nX20\nG1 Z-1\nX30\nG0 Z5\nM5\nM30\n";

constexpr double sampled = 0.05; // mm: two places on both sides of a corner

const ToolChangePlan stop_plan{.way = ToolChangeWay::stop, .spin_up = 2.0};

TEST(GrblToolChange, WaitsWithEverythingBeforeItExecutedAndTheSpindleOff) {
    ToolChangeWire wire;
    wire.begin(two_tools, stop_plan);
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
    const DriverStatus status = wire.session.status();
    EXPECT_EQ(status.message, "change to tool 3 at line 8: M6 (6 mm end mill)");
    EXPECT_EQ(status.executed_blocks, 7);
    EXPECT_EQ(status.sent_blocks, 7);
    EXPECT_EQ(status.block, 7);
    EXPECT_EQ(status.spindle, gcode::SpindleTurning::stopped);
    EXPECT_THAT(status.own_lines, testing::ElementsAre("M5", "M9"));
    EXPECT_EQ(wire.grbl.position(), (std::array<double, 3>{10.0, 0.0, 8.0}));
    EXPECT_THAT(wire.sent, Not(HasSubstr("M6")));
    wire.sent.clear();
    wire.run_until([] { return false; }, 10.0);
    EXPECT_EQ(wire.sent_lines(), "");
    EXPECT_TRUE(wire.waits());
}

TEST(GrblToolChange, GoesBackUpFirstAndOnWithTheNextLine) {
    ToolChangeWire wire;
    wire.begin(two_tools, stop_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.jog({-40.0, 25.0, 0.0});
    wire.jog({0.0, 0.0, -20.0});
    ASSERT_TRUE(wire.waits());
    wire.sent.clear();
    wire.session.resume(wire.now);
    const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    EXPECT_GE(ToolChangeWire::lowest_across(path), 8.0 - sampled);
    EXPECT_EQ(wire.grbl.position(), (std::array<double, 3>{10.0, 0.0, 8.0}));
    const std::string lines = wire.sent_lines();
    const auto at = [&lines](const char* text) { return lines.find(text); };
    EXPECT_LT(at("G53G0Z8"), at("G53G0X10"));
    EXPECT_LT(at("G53G0X10"), at("M3S1000"));
    EXPECT_LT(at("M3S1000"), at("G4P2.0"));
    EXPECT_LT(at("G4P2.0"), at("G53G1Z8"));
    ASSERT_NE(at("G53G1Z8"), std::string::npos) << lines;
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().executed_blocks, 14);
    EXPECT_EQ(wire.session.status().tool, 3);
    EXPECT_EQ(wire.grbl.position(), (std::array<double, 3>{30.0, 0.0, 5.0}));
}

/// The zero that the person sets for the new tool is where it comes down.
TEST(GrblToolChange, ComesDownInTheWorkCoordinatesOfTheNewTool) {
    for (const double zero : {-7.0, 6.0}) { // of Z, machine coordinates: a shorter tool, a longer one
        ToolChangeWire wire;
        wire.begin(two_tools, stop_plan);
        ASSERT_TRUE(wire.run_to_change());
        wire.jog({-40.0, 0.0, zero - 8.0});
        wire.command("G10 L20 P0 Z0");
        ASSERT_TRUE(wire.waits());
        wire.session.resume(wire.now);
        const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
        EXPECT_GE(ToolChangeWire::lowest_across(path), std::max(8.0, 8.0 + zero) - sampled);
        EXPECT_NEAR(wire.grbl.position()[2], 8.0 + zero, 0.001);
        EXPECT_TRUE(wire.run_to_end());
        EXPECT_NEAR(wire.grbl.position()[2], 5.0 + zero, 0.001);
    }
}

/// The height that the program has reached counts from the zero of the tool in the spindle.
TEST(GrblToolChange, KeepsTheProgramsHeightAlsoAfterAnEarlierChange) {
    ToolChangeWire wire;
    wire.begin("G21 G90\nG0 Z20\nX10\nZ8\nT2 M6\nX20\nT3 M6\nX30\nM30\n", stop_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.jog({0.0, 0.0, -2.0});
    wire.command("G10 L20 P0 Z0"); // at 6 of the machine
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.waits(); }, 5.0);
    ASSERT_TRUE(wire.run_to_change());
    wire.session.resume(wire.now);
    const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    double top = 0.0;
    for (const auto& place : path) {
        top = std::max(top, place[2]);
    }
    EXPECT_NEAR(top, 26.0, 0.01);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_NEAR(wire.grbl.position()[2], 14.0, 0.001);
}

TEST(GrblToolChange, BringsEveryModeBack) {
    const std::string program = "G0 G21 G90 G94 Z5\nG55 G18 G20 G0 Z0.5\nG1 F20 Z0.4\nM4 S700\nM8\nG93\nM6\n"
                                "G1 X1 F3\n";
    ToolChangeWire wire;
    wire.begin(program, stop_plan);
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().message, "change the tool at line 7: M6");
    wire.jog({5.0, 5.0, 5.0});
    wire.command("G54 G17 G21 G90 G94 G0 F77");
    std::string after;
    wire.on_the_way = [&](std::string& bytes) {
        const std::size_t next = bytes.find("G1X1F3");
        if (next != std::string::npos) {
            bytes.replace(next, 7, "");
            after = bytes;
        }
    };
    wire.session.resume(wire.now);
    wire.run_until([&] { return !after.empty(); }, 60.0);
    wire.on_the_way = {};
    wire.run_until([] { return false; }, 1.0);
    (void)wire.grbl.take_output();
    wire.grbl.receive("$G\n");
    wire.grbl.advance(0.2);
    EXPECT_THAT(wire.grbl.take_output(), HasSubstr("[GC:G1 G55 G18 G20 G90 G93 M4 M8 T0"));
}

TEST(GrblToolChange, DoesNotMoveWhereTheProgramHasMovedNothing) {
    ToolChangeWire wire;
    wire.begin("G21 G90 G94\nT1 M6\nM3 S500\nG0 Z5\nG0 X5\n", stop_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.jog({3.0, 4.0, -2.0});
    const auto there = wire.grbl.position();
    wire.session.resume(wire.now);
    const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    EXPECT_EQ(path.size(), 1u);
    EXPECT_EQ(wire.grbl.position(), there);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[2], 5.0);
}

TEST(GrblToolChange, ToTheSameToolAgainStopsNobody) {
    ToolChangeWire wire;
    wire.begin("G21 G90\nT1 M6\nG0 Z5\nT1 M6\nG0 X5\nT2 M6\nG0 X6\n", stop_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.session.resume(wire.now);
    wire.run_until([&] { return !wire.waits(); }, 5.0);
    ASSERT_TRUE(wire.run_to_change());
    EXPECT_THAT(wire.session.status().message, HasSubstr("change to tool 2 at line 6"));
    EXPECT_EQ(wire.grbl.position()[0], 5.0);
}

/// A hold between the steps of the way back holds; going on with it is not going on with the tool change.
TEST(GrblToolChange, HonoursAHoldAtEveryMoment) {
    int holds = 0;
    for (int moment = 0; moment < 60; ++moment) {
        ToolChangeWire wire;
        wire.begin(two_tools, stop_plan);
        wire.run_until([&] { return wire.session.status().tool_change.has_value(); }, 60.0);
        if (moment >= 15) {
            ASSERT_TRUE(wire.run_to_change());
            wire.jog({-20.0, 0.0, -5.0});
            wire.session.resume(wire.now);
        }
        wire.run_until([] { return false; }, 0.03 + 0.1 * (moment % 45));
        const bool on_its_way = wire.session.status().tool_change && !wire.waits();
        if (!on_its_way) {
            continue;
        }
        wire.session.hold(wire.now);
        EXPECT_EQ(wire.state(), DriverState::holding) << moment;
        wire.run_until([] { return false; }, 2.0);
        const auto there = wire.grbl.position();
        wire.sent.clear();
        wire.run_until([] { return false; }, 5.0);
        EXPECT_EQ(wire.grbl.position(), there) << moment;
        EXPECT_THAT(wire.sent_lines(), Not(HasSubstr("G53"))) << moment;
        EXPECT_EQ(wire.state(), DriverState::holding) << moment;
        wire.session.resume(wire.now);
        if (moment < 15) {
            ASSERT_TRUE(wire.run_to_change()) << moment;
            wire.run_until([] { return false; }, 2.0);
            EXPECT_TRUE(wire.waits()) << moment;
            wire.session.resume(wire.now);
        }
        EXPECT_TRUE(wire.run_to_end()) << moment;
        EXPECT_EQ(wire.session.status().executed_blocks, 14) << moment;
        ++holds;
    }
    EXPECT_GT(holds, 30);
}

TEST(GrblToolChange, SendsNothingAfterAStopALostLinkOrAnEmergency) {
    enum class End { stop, emergency, cut };
    for (const End how : {End::stop, End::emergency, End::cut}) {
        for (int moment = 0; moment < 24; ++moment) {
            ToolChangeWire wire;
            wire.begin(two_tools, stop_plan);
            ASSERT_TRUE(wire.run_to_change());
            if (moment > 0) {
                wire.jog({-20.0, 0.0, -5.0});
                wire.session.resume(wire.now);
                wire.run_until([] { return false; }, 0.01 + 0.15 * moment);
            }
            if (!wire.session.status().tool_change) {
                break;
            }
            how == End::stop        ? wire.session.stop(wire.now)
            : how == End::emergency ? wire.session.emergency_stop(wire.now)
                                    : wire.cut();
            wire.step();
            wire.sent.clear();
            wire.run_until([] { return false; }, 8.0);
            const std::string lines = wire.sent_lines();
            EXPECT_THAT(lines, Not(testing::AnyOf(HasSubstr("G0"), HasSubstr("G1"), HasSubstr("M3"))))
                << moment;
            EXPECT_EQ(wire.state(), how == End::stop ? DriverState::stopped : DriverState::alarm) << moment;
            EXPECT_EQ(wire.session.status().executed_blocks, 7) << moment;
            EXPECT_FALSE(wire.session.status().tool_change);
            wire.session.resume(wire.now);
            wire.run_until([] { return false; }, 1.0);
            EXPECT_THAT(wire.sent_lines(), Not(HasSubstr("G53"))) << moment;
        }
    }
}

TEST(GrblToolChange, TakesJogsAndCommandsOnlyWhileItWaits) {
    ToolChangeWire wire;
    wire.begin(two_tools, stop_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.jog({-20.0, 0.0, -5.0});
    EXPECT_THROW(wire.start("G0 X1\n"), Error);
    EXPECT_THROW((void)wire.session.check(command_lines("G0 X1"), wire.now), Error);
    wire.session.resume(wire.now);
    for (int n = 0; n < 400 && wire.session.status().tool_change; ++n) {
        EXPECT_THROW((void)wire.session.command(command_lines("G0 X1"), wire.now), Error);
        EXPECT_THROW(wire.session.jog({kinematics::AxisPositions(Vec3(1.0, 0.0, 0.0)), 5.0, 0.0}, wire.now),
                     Error);
        wire.step();
    }
    EXPECT_TRUE(wire.run_to_end());
}

/// Where the new zero lies too high for the machine, the person is asked again.
TEST(GrblToolChange, DoesNotGoBackBeyondTheMachine) {
    ToolChangeWire wire;
    wire.home_machine();
    wire.command("G10 L2 P1 X-200 Y-100 Z-50");
    wire.begin(two_tools, stop_plan);
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
    wire.command("G10 L2 P1 Z-3");
    wire.sent.clear();
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 2.0);
    EXPECT_TRUE(wire.waits());
    EXPECT_THAT(wire.session.status().message, HasSubstr("outside -100.000 ... 0.000"));
    EXPECT_EQ(wire.sent_lines(), "");
    wire.command("G10 L2 P1 Z-45");
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_NEAR(wire.grbl.position()[2], -40.0, 0.001);
}

/// Grbl reports machine positions, or those of the work.
class GrblToolLengths : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Reports, GrblToolLengths, testing::Values("$10=1", "$10=2"));

TEST_P(GrblToolLengths, AreThoseOfEachToolAndEndWithTheJob) {
    Bench wire;
    wire.command(GetParam());
    wire.begin(three_tools, probe_plan);
    double lowest = 0.0;
    for (const double longer : {0.0, 4.0, -3.0}) {
        ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
        wire.longer = longer;
        wire.session.resume(wire.now);
        const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
        EXPECT_GE(ToolChangeWire::lowest_across(path), -2.0 - sampled) << longer;
        lowest = 0.0;
        const auto cut = wire.path_while([&] { return !wire.waits() && !wire.ended(); });
        for (const auto& place : cut) {
            lowest = std::min(lowest, place[0] < -150.0 ? place[2] : 0.0);
        }
        EXPECT_NEAR(lowest, -49.0 + longer, 0.02) << longer;
    }
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().executed_blocks, 15);
    EXPECT_EQ(wire.session.readout().offsets.at("TLO")[2], 0.0);
    EXPECT_EQ(wire.session.status().own_lines.back(), "G49");
    wire.begin(three_tools, probe_plan);
    EXPECT_TRUE(wire.run_to_change());
}

/// A program that moves before its first change has its first tool in the spindle.
TEST(GrblToolSensor, MeasuresTheFirstToolBeforeTheFirstLine) {
    Bench wire;
    const auto began = wire.grbl.position();
    wire.begin("G21 G90 G94\nG0 Z5\nX10\nT2 M6\nX20\nG0 Z1\nM30\n", probe_plan);
    const auto path = wire.path_while([&] { return wire.session.readout().probings < 2; });
    EXPECT_GE(ToolChangeWire::lowest_across(path), -2.0 - sampled);
    const auto back = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    EXPECT_GE(ToolChangeWire::lowest_across(back), -2.0 - sampled);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(wire.grbl.position()[static_cast<std::size_t>(axis)],
                    began[static_cast<std::size_t>(axis)],
                    0.01);
    }
    ASSERT_TRUE(wire.run_to_change()) << wire.session.status().message;
    wire.longer = 2.5;
    wire.session.resume(wire.now);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_NEAR(wire.grbl.position()[2], -49.0 + 2.5, 0.02);
}

TEST(GrblToolSensor, EndsTheJobWhereNothingIsTouched) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    ASSERT_TRUE(wire.run_to_change());
    wire.longer = -200.0;
    wire.session.resume(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("alarm 5"));
    wire.sent.clear();
    wire.run_until([] { return false; }, 5.0);
    EXPECT_THAT(wire.sent_lines(), Not(HasSubstr("G")));
}

/// The length of a tool does not leak into the next job.
TEST(GrblToolSensor, LeavesNoLengthBehindAStop) {
    Bench wire;
    wire.begin(three_tools, probe_plan);
    for (const double longer : {0.0, 4.0}) {
        ASSERT_TRUE(wire.run_to_change());
        wire.longer = longer;
        wire.session.resume(wire.now);
        wire.run_until([&] { return !wire.session.status().tool_change; }, 120.0);
    }
    EXPECT_NEAR(wire.session.readout().offsets.at("TLO")[2], 4.0, 0.02);
    wire.session.stop(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::stopped);
    EXPECT_EQ(wire.session.readout().offsets.at("TLO")[2], 0.0);
    EXPECT_THAT(wire.session.status().own_lines.back(), HasSubstr("cancelled the tool length offset"));
    wire.command("G43.1 Z3");
    EXPECT_THROW(wire.begin(three_tools, probe_plan), Error);
}

TEST(GrblToolMacro, IsSentAfterThePersonAndThenTheToolGoesBack) {
    Bench wire;
    ToolChangePlan plan = probe_plan;
    plan.way = ToolChangeWay::macro;
    plan.macro = "; to the corner\ng53 g0 z-1\ng53 g0 x-5 y-5\nG4 P0.1\nG43.1 Z2\n";
    wire.begin("G21 G90 G94\nG0 Z5\nX10\nT2 M6\nX20\nM30\n", plan);
    ASSERT_TRUE(wire.run_to_change());
    const auto before = wire.grbl.position();
    wire.sent.clear();
    wire.session.resume(wire.now);
    const auto path = wire.path_while([&] { return wire.session.status().tool_change.has_value(); });
    EXPECT_GE(ToolChangeWire::lowest_across(path), -1.0 - sampled);
    EXPECT_THAT(wire.sent_lines(), HasSubstr("G53G0Z-1\nG53G0X-5Y-5\n"));
    EXPECT_NEAR(wire.grbl.position()[0], before[0], 0.001);
    EXPECT_NEAR(wire.grbl.position()[2], before[2] + 2.0, 0.001);
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.session.readout().offsets.at("TLO")[2], 0.0) << "its length is not the next job's";
}

} // namespace
} // namespace millwright::drivers::grbl
