#include "core/jobs/box_trace.h"

#include "core/base/error.h"
#include "core/gcode/axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::jobs {
namespace {

using kinematics::AxisKind;
using testing::HasSubstr;
using testing::Not;

Job traced(const std::string& program, double z = 0.0) {
    const Job job = text_job(program, "part.ngc");
    ProgramCheckSettings settings;
    settings.dialect = gcode::Dialect::grbl;
    settings.axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};
    settings.start = kinematics::AxisPositions::Zero(3);
    settings.start[2] = z;
    settings.offsets = {{"G54", kinematics::AxisPositions::Zero(3)}};
    settings.offsets[0].value[0] = 100.0;
    return box_trace_job(job, check_program(program, "part.ngc", settings));
}

constexpr const char* disc =
    "G21 G90 F600\nG0 Z5\nG0 X-70 Y-70\nG0 X10 Y0\nG1 Z-1\nG3 X10 Y0 I-10 J0\nG0 Z5\nG0 X0 Y50\nM2\n";

/// A circle of 10 mm about the work zero, which lies at X 100; rapids go farther and do not count.
TEST(BoxTrace, GoesAroundTheCutsInMachineCoordinates) {
    const Job job = traced(disc);
    EXPECT_EQ(job.name, "part-box");
    EXPECT_EQ(job.listing->text,
              "(box of the cuts, machine coordinates)\nM5\nG21 G90 G94 G40\nG53 G0 Z5.000\n"
              "G53 G1 X90.000 Y-10.000 F1000\nG53 G1 X110.000 Y-10.000 F1000\nG53 G1 X110.000 Y10.000 F1000\n"
              "G53 G1 X90.000 Y10.000 F1000\nG53 G1 X90.000 Y-10.000 F1000\nM2\n");
}

TEST(BoxTrace, NeverGoesDown) {
    EXPECT_THAT(traced(disc, 8.0).listing->text, Not(HasSubstr("Z")));
}

TEST(BoxTrace, OfAProgramWithoutCutsThereIsNone) {
    EXPECT_THROW((void)traced("G21 G90\nG0 X10 Y10\nM2\n"), Error);
    EXPECT_THROW((void)traced("G21 G90 F100\nG1 Z-5\nM2\n"), Error); // a hole is no box
    EXPECT_THAT(traced("G21 G90 F100\nG1 X5\nM2\n").listing->text, HasSubstr("G53 G1 X105.000 Y0.000"));
}

} // namespace
} // namespace millwright::jobs
