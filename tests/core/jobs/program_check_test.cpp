#include "core/jobs/program_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::jobs {
namespace {

using gcode::Dialect;
using kinematics::AxisKind;
using testing::HasSubstr;

const std::vector<program::ProgramAxis> xyz = {
    {'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};

TEST(ProgramCheck, FindsHowFarAProgramGoesAndWhere) {
    const ProgramCheck found = check_program("G21 G90\nG0 X-5 Y2\nG1 X30 F600\nG0 Z4\nM2\n", "a.ngc", {});
    EXPECT_TRUE(found.errors.empty());
    EXPECT_EQ(found.ranges[0].min, -5.0);
    EXPECT_EQ(found.ranges[0].min_line, 2);
    EXPECT_EQ(found.ranges[0].max, 30.0);
    EXPECT_EQ(found.ranges[0].max_line, 3);
    EXPECT_EQ(found.ranges[2].max, 4.0);
    EXPECT_EQ(found.greatest_feed, 10.0);
    EXPECT_EQ(found.first_cut_line, 3);
    EXPECT_FALSE(found.spindle_before_cut);
}

TEST(ProgramCheck, FollowsArcsToTheirFarthestPoints) {
    const ProgramCheck half = check_program("G21 G17\nG0 X10\nG3 X-10 I-10 F100\nM2\n", "a.ngc", {});
    EXPECT_NEAR(half.ranges[1].max, 10.0, 1e-9);
    EXPECT_NEAR(half.ranges[1].min, 0.0, 1e-9);
    const ProgramCheck full = check_program("G21 G17\nG0 X10\nG2 I-10 F100\nM2\n", "a.ngc", {});
    EXPECT_NEAR(full.ranges[0].min, -10.0, 1e-9);
    EXPECT_NEAR(full.ranges[1].min, -10.0, 1e-9);
}

TEST(ProgramCheck, KnowsWhereTheWorkIs) {
    kinematics::AxisPositions offset = kinematics::AxisPositions::Zero(3);
    offset[0] = -100.0;
    const ProgramCheckSettings settings{
        Dialect::grbl, xyz, kinematics::AxisPositions::Zero(3), {{"G55", offset}}};
    const ProgramCheck found = check_program("G21 G90 G55\nG0 X5\nG54\nG0 X1\n", "a.ngc", settings);
    EXPECT_EQ(found.ranges[0].min, -95.0);
    EXPECT_EQ(found.ranges[0].max, 1.0);
}

TEST(ProgramCheck, SaysWhatStandsAgainstAProgram) {
    drivers::MachineLimits limits;
    limits.axes = {{'X', -200.0, 0.0, 50.0}};
    const ProgramCheck found = check_program("G21 G90\nG0 X-5\nG0 X3\nG1 Y1 F9000\nM2\n", "a.ngc", {});
    const auto faults = faults_of(found, limits, "a.ngc");
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].place.line, 3);
    EXPECT_THAT(faults[0].message,
                HasSubstr("axis X would move to 3.000 mm in machine coordinates, outside -200.000"));
    EXPECT_TRUE(faults_of(found, {}, "a.ngc").empty());
}

/// A controller without homing tells how long its axes are, not where they begin.
TEST(ProgramCheck, SaysWhatIsLongerThanATravelWithoutAnOrigin) {
    drivers::MachineLimits limits;
    limits.axes = {{.letter = 'X', .min = {}, .max = {}, .speed = {}, .travel = 200.0}};
    const auto faults = [&limits](std::string_view text, double start) {
        kinematics::AxisPositions at = kinematics::AxisPositions::Zero(3);
        at[0] = start;
        return faults_of(check_program(text, "a.ngc", {Dialect::grbl, xyz, at, {}}), limits, "a.ngc");
    };
    const auto far = faults("G21\nG0 X99999\nM2\n", 0.0);
    ASSERT_EQ(far.size(), 1U);
    EXPECT_EQ(far[0].place.line, 2);
    EXPECT_THAT(far[0].message,
                HasSubstr("axis X would move from 0.000 mm to 99999.000 mm in machine coordinates, a "
                          "distance of 99999.000 mm, but its travel is only 200.000 mm"));
    const auto back = faults("G21\nG0 X150\nG0 Y1\nG0 X-50.01\nM2\n", 0.0);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].place.line, 4);
    EXPECT_THAT(back[0].message, HasSubstr("from 150.000 mm to -50.010 mm"));
    EXPECT_TRUE(faults("G21\nG0 X150\nG0 X-50\nM2\n", 0.0).empty());
    EXPECT_TRUE(faults("G21\nG0 X1150\nG0 X950\nM2\n", 1000.0).empty());
    EXPECT_EQ(faults("G21\nG0 X1150\nG0 X950\nM2\n", 1150.1).size(), 1U);
}

TEST(ProgramCheck, SaysWhatAPersonShouldKnow) {
    drivers::MachineLimits limits;
    limits.axes = {{'X', {}, {}, 50.0}};
    limits.spindle_rpm = 1000.0;
    const ProgramCheck found = check_program("G21 T3 M6\nT5 M6\nS2000\nG1 X3 F9000\nM2\n", "a.ngc", {});
    std::string all;
    for (const Diagnostic& one : warnings_of(found, limits, "a.ngc")) {
        all += to_text(one) + "\n";
    }
    EXPECT_THAT(all, HasSubstr("T3, T5"));
    EXPECT_THAT(all, HasSubstr("a.ngc:4: the first cut comes before the spindle"));
    EXPECT_THAT(all, HasSubstr("9000 mm/min exceeds the machine's maximum in any direction, 3000 mm/min"));
    EXPECT_THAT(all, HasSubstr("2000 rpm"));
}

TEST(ProgramCheck, ReportsErrorsWithTheirPlace) {
    const ProgramCheck found = check_program("G21\nG1 X1\nG5 X1\n", "a.ngc", {Dialect::grbl, {}, {}, {}});
    ASSERT_FALSE(found.errors.empty());
    EXPECT_EQ(faults_of(found, {}, "a.ngc").front().place.file, "a.ngc");
}

/// A controller begins with what it has in force.
// Only the first one was named, and by LinuxCNC's rules none.
TEST(ProgramCheck, NamesAllAxesThatTheMachineLacks) {
    const char* const text = "G21 G90\nM3 S1000\nG0 X1\nG1 B10 F100\nG1 A5 C3\nM2\n";
    for (const Dialect dialect : {Dialect::grbl, Dialect::linuxcnc}) {
        ProgramCheckSettings settings{dialect, xyz, {}, {}};
        const ProgramCheck three = check_program(text, "a.ngc", settings);
        EXPECT_EQ(three.missing_axes, "ABC");
        const auto faults = faults_of(three, {}, "a.ngc");
        ASSERT_FALSE(faults.empty());
        EXPECT_EQ(faults.front().place.line, 4);
        EXPECT_EQ(faults.front().message,
                  "the program moves A, B and C, but the machine has only X, Y and Z");
        settings.axes.push_back({'A', AxisKind::rotary});
        EXPECT_EQ(check_program(text, "a.ngc", settings).missing_axes, "BC");
        settings.axes.push_back({'B', AxisKind::rotary});
        settings.axes.push_back({'C', AxisKind::rotary});
        EXPECT_TRUE(check_program(text, "a.ngc", settings).errors.empty());
    }
    EXPECT_TRUE(check_program(text, "a.ngc", {}).errors.empty()) << "nothing is known of the machine";
}

TEST(ProgramCheckModes, CountInInchesWhereTheControllerDoes) {
    ProgramCheckSettings settings{Dialect::grbl, xyz, kinematics::AxisPositions::Zero(3), {}};
    settings.modes = "G0 G54 G17 G20 G90 G94 M5 M9 T0 F0 S0";
    const ProgramCheck found = check_program("G90 G54\nG0 X10\nG0 X0\nM30\n", "a.ngc", settings);
    EXPECT_TRUE(found.errors.empty());
    EXPECT_NEAR(found.ranges[0].max, 254.0, 1e-9);
    EXPECT_TRUE(found.tools.empty());
}

TEST(ProgramCheckModes, GoOnFromWhereTheMachineIsUnderG91) {
    ProgramCheckSettings settings{Dialect::grbl, xyz, kinematics::AxisPositions::Zero(3), {}};
    settings.modes = "G0 G54 G17 G21 G91 G94 M5 M9 T0 F0 S0";
    EXPECT_NEAR(check_program("G21\nG0 X10\nG0 X20\nG0 X10\n", "a.ngc", settings).ranges[0].max, 40.0, 1e-9);
}

TEST(ProgramCheckModes, TakeWorkSystemMotionFeedAndToolLength) {
    const kinematics::AxisPositions offset = Vec3(100.0, 0.0, 0.0);
    const kinematics::AxisPositions length = Vec3(0.0, 0.0, 7.0);
    ProgramCheckSettings settings{
        Dialect::grbl, xyz, kinematics::AxisPositions::Zero(3), {{"G55", offset}, {"TLO", length}}};
    settings.modes = "G1 G55 G18 G21 G90 G94 M3 M8 T1 F300 S1000";
    const ProgramCheck found = check_program("X5\nZ1\n", "a.ngc", settings);
    EXPECT_TRUE(found.errors.empty()) << to_text(found.errors.front());
    EXPECT_NEAR(found.ranges[0].max, 105.0, 1e-9);
    EXPECT_NEAR(found.ranges[2].max, 8.0, 1e-9);
    EXPECT_TRUE(found.spindle_before_cut);
    settings.modes = "G2 G54 G17 G21 G90 G94 M5 M9 T0 F300 S0";
    EXPECT_FALSE(check_program("X5 Y1\n", "a.ngc", settings).errors.empty()); // an arc without its centre
    settings.modes = "G1 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0";
    EXPECT_FALSE(check_program("X5\n", "a.ngc", settings).errors.empty()); // without feed
}

} // namespace
} // namespace millwright::jobs
