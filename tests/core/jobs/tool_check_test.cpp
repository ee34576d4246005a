#include "core/jobs/tool_check.h"

#include "core/jobs/box_trace.h"
#include "core/jobs/run_from_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::jobs {
namespace {

using kinematics::AxisKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string two_tools = "G21 G90 G94\nG0 Z5\nG1 X5 F100\nG0 Z6\nT2 M6\nG1 X8 Z1\nG0 Z3\nM30\n";

Job job_of(const std::string& text, drivers::ToolChangeWay way = drivers::ToolChangeWay::stop) {
    Job job = text_job(text, "test.ngc");
    job.tool_change = drivers::ToolChangePlan{
        .way = way, .sensor = {.x = -10.0, .y = -20.0, .travel_z = -2.0, .deepest_z = -50.0}};
    return job;
}

drivers::DriverStatus machine_at_rest() {
    drivers::DriverStatus status;
    status.state = drivers::DriverState::idle;
    status.position = Vec3(-100.0, -100.0, -50.0);
    status.work_offset = Vec3(-100.0, -100.0, -60.0);
    status.modes = "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0";
    return status;
}

std::vector<drivers::StoredOffset> offsets_of(double length = 0.0) {
    return {{"G54", Vec3(-100.0, -100.0, -60.0)}, {"TLO", Vec3(0.0, 0.0, length)}};
}

drivers::MachineLimits homed() {
    drivers::MachineLimits limits;
    limits.axes = {{.letter = 'X', .min = -300.0, .max = 0.0, .speed = {}},
                   {.letter = 'Y', .min = -300.0, .max = 0.0, .speed = {}},
                   {.letter = 'Z', .min = -90.0, .max = 0.0, .speed = {}}};
    return limits;
}

ProgramCheck checked(const Job& job) {
    const drivers::DriverStatus status = machine_at_rest();
    return check_program(controller_text(job),
                         "test.ngc",
                         {.dialect = gcode::Dialect::grbl,
                          .axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}},
                          .start = status.position,
                          .offsets = offsets_of(),
                          .modes = status.modes,
                          .watched = watched_lines(job)});
}

drivers::Capabilities able() {
    drivers::Capabilities can;
    can.dialect = gcode::Dialect::grbl;
    can.program.tool_changes = true;
    can.axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};
    return can;
}

std::string faults(const Job& job,
                   const drivers::DriverStatus& status = machine_at_rest(),
                   const drivers::MachineLimits& limits = homed(),
                   double length = 0.0,
                   bool laser = false) {
    const auto offsets = offsets_of(length);
    std::string text;
    for (const Diagnostic& fault :
         tool_change_faults(job, checked(job), able(), {status, offsets, limits, laser})) {
        text += to_text(fault) + "\n";
    }
    return text;
}

TEST(ToolCheck, FindsEachChangeWithItsToolAndName) {
    const auto calls =
        tool_calls("(T1 D=6. CR=0. - FLAT END MILL)\nT1 M6\nG0 X1 (M6)\nm06 t2 ; a drill\nT2\nM6\n"
                   "M60\nG1 X1 M6.5\nM 6 T3\n");
    ASSERT_EQ(calls.size(), 4u);
    EXPECT_EQ(calls[0].line, 2);
    EXPECT_EQ(calls[0].tool, 1);
    EXPECT_EQ(calls[0].name, "T1 D=6. CR=0. - FLAT END MILL");
    EXPECT_EQ(calls[1].line, 4);
    EXPECT_EQ(calls[1].name, "a drill");
    EXPECT_TRUE(calls[2].again);
    EXPECT_EQ(calls[3].tool, 3);
}

TEST(ToolCheck, LeavesOutTheChangesAlone) {
    EXPECT_EQ(without_tool_changes("T1 M6 G0 X1\n(M6)\nM06\nM60\n"), "T1    G0 X1\n(M6)\n   \nM60\n");
    const Job job = job_of(two_tools);
    EXPECT_THAT(checked(job).errors, IsEmpty());
    Job left = job;
    left.tool_change.reset();
    EXPECT_EQ(controller_text(left), two_tools);
}

TEST(ToolCheck, TellsWhereTheJobStopsAndHowHighItWas) {
    const Job job = job_of(two_tools, drivers::ToolChangeWay::probe);
    const drivers::ToolChanges changes = tool_changes(job, checked(job));
    ASSERT_EQ(changes.stops.size(), 1u);
    EXPECT_EQ(changes.stops[0].line, 5);
    EXPECT_EQ(changes.stops[0].why, "change to tool 2 at line 5: M6");
    ASSERT_TRUE(changes.stops[0].highest_z);
    EXPECT_DOUBLE_EQ(*changes.stops[0].highest_z, -50.0); // where it stood is higher than Z6
    EXPECT_TRUE(changes.reference_first);
    const Job first = job_of("G21 G90\nT1 M6\nG0 Z5\n", drivers::ToolChangeWay::probe);
    const drivers::ToolChanges before = tool_changes(first, checked(first));
    EXPECT_FALSE(before.stops.at(0).highest_z);
    EXPECT_FALSE(before.reference_first);
}

TEST(ToolCheck, RefusesWhatItCouldNotComeBackFrom) {
    EXPECT_EQ(faults(job_of(two_tools)), "");
    EXPECT_THAT(faults(job_of("G21 G90\nG0 Z5\nG91\nT2 M6\nG1 X1 F100\n")),
                HasSubstr("test.ngc:4: G91 is active at this tool change"));
    EXPECT_THAT(faults(job_of("G21 G90\nG0 X5\nT2 M6\nG0 Z5\n")),
                HasSubstr("test.ngc:3: the program has not raised Z before this tool change"));
    EXPECT_THAT(faults(job_of("G21 G90\nG0 Z5\nG2 X5 I2 F100\nT2 M6\nG0 Z5\n")),
                HasSubstr("test.ngc:4: an arc or probing motion is active"));
    drivers::DriverStatus doubted = machine_at_rest();
    doubted.position_doubt = "the controller was reset";
    EXPECT_EQ(faults(job_of(two_tools), doubted), "") << "all distances count from where it is";
    EXPECT_THAT(faults(job_of(two_tools, drivers::ToolChangeWay::probe), doubted),
                HasSubstr("needs a verified position"));
    doubted.position_lost = true;
    EXPECT_THAT(faults(job_of(two_tools), doubted),
                HasSubstr("needs a verified position: the controller was reset"));
    EXPECT_THAT(faults(job_of(two_tools), machine_at_rest(), homed(), 3.0),
                HasSubstr("a tool length offset of 3.000 mm from an earlier tool is active"));
    EXPECT_THAT(faults(job_of(two_tools), machine_at_rest(), homed(), 0.0, true), HasSubstr("laser mode"));
    EXPECT_EQ(faults(job_of("G21 G90\nG0 X5\nM30\n"), doubted), "") << "it changes no tool";
}

TEST(ToolCheck, CoversTheWayToTheSensor) {
    EXPECT_EQ(faults(job_of(two_tools, drivers::ToolChangeWay::probe)), "");
    Job job = job_of(two_tools, drivers::ToolChangeWay::probe);
    job.tool_change->sensor.x = 3.0;
    EXPECT_THAT(faults(job), HasSubstr("the tool sensor's X 3.000 is outside -300.000 ... 0.000"));
    job.tool_change->sensor.x = job.tool_change->sensor.y = 0.0;
    EXPECT_THAT(faults(job), HasSubstr("the position of the tool sensor is not set"));
    job.tool_change->sensor.x = -3.0;
    job.tool_change->sensor.deepest_z = -95.0;
    EXPECT_THAT(faults(job), HasSubstr("the tool sensor's Z -95.000 is outside"));
    job.tool_change->sensor.deepest_z = -1.0;
    EXPECT_THAT(faults(job), HasSubstr("is not below the travel height"));
    EXPECT_THAT(
        faults(job_of(two_tools, drivers::ToolChangeWay::probe), machine_at_rest(), drivers::MachineLimits{}),
        HasSubstr("the tool sensor needs a machine that homes"));
    EXPECT_THAT(faults(job_of("G21 G90\nG0 Z5\nT2 M6\nG49\nG0 Z5\n", drivers::ToolChangeWay::probe)),
                HasSubstr("test.ngc:4: the program sets a tool length"));
    EXPECT_EQ(faults(job_of("G21 G90\nG0 Z5\nT2 M6\nG49\nG0 Z5\n")), "");
}

TEST(ToolCheck, ReadsTheMacroBeforeTheJob) {
    Job job = job_of(two_tools, drivers::ToolChangeWay::macro);
    job.tool_change->macro_file = "change.nc";
    EXPECT_THAT(faults(job), HasSubstr("change.nc: the tool change macro is empty"));
    job.tool_change->macro = "G53 G0 Z-1\n";
    EXPECT_EQ(faults(job), "");
    job.tool_change->macro = "G53 G0 Z-1\n T1 M6\n";
    EXPECT_THAT(faults(job), HasSubstr("change.nc:2:5: the tool change macro contains M6"));
    job.tool_change->macro = "G43 H1\n";
    EXPECT_THAT(faults(job), HasSubstr("change.nc:1"));
    job.tool_change->macro = "G53 G0 Z-1\nG53 G0 X-310\n";
    EXPECT_THAT(faults(job), HasSubstr("change.nc:2: axis X would move to -310.000 mm"));
    job.tool_change->macro = "M30\n";
    EXPECT_THAT(faults(job), HasSubstr("contains M30"));
}

TEST(ToolCheck, ABeginningInTheMiddleNamesTheTool) {
    std::string text = "G21 G90 G94\nT1 M6\nG0 Z5\nG0 X1 Y1\nG1 Z1 F100\nG0 Z5\nT2 M6\nG0 X5 Y5\n";
    for (int n = 0; n < 8; ++n) {
        text += "G1 X" + std::to_string(n) + "\n";
    }
    text += "T3 M6\nG0 X1\nM30\n";
    Job whole = job_of(text, drivers::ToolChangeWay::probe);
    const Job rest = job_from_line(whole, 12, {.dialect = gcode::Dialect::grbl, .clearance = {}});
    EXPECT_EQ(rest.tool_at_start, 2);
    EXPECT_EQ(faults(rest), "") << "the approach cancels a length itself";
    EXPECT_EQ(tool_before_start(rest, checked(rest)),
              "Tool 2 must be in the spindle at line 12, and the Z zero must be set with it: it is measured "
              "first.");
    EXPECT_THAT(watched_lines(rest), ElementsAre(17)) << "the line numbers are those of the file";
    EXPECT_TRUE(tool_changes(rest, checked(rest)).reference_first);
    EXPECT_EQ(tool_before_start(whole, checked(whole)), "");
    const Job last = job_from_line(whole, 18, {.dialect = gcode::Dialect::grbl, .clearance = {}});
    EXPECT_EQ(tool_before_start(last, checked(last)),
              "Tool 3 must be in the spindle at line 18, and the Z zero must be set with it.");
    EXPECT_TRUE(tool_changes(last, checked(last)).needs_zero);
    whole.tool_change.reset();
    whole.listing = text_job(without_tool_changes(text), "test.ngc").listing;
    EXPECT_EQ(job_from_line(whole, 12, {.dialect = gcode::Dialect::grbl, .clearance = {}}).tool_at_start,
              std::nullopt);
}

/// A T alone selects a tool, which is in the spindle after the next M6.
TEST(ToolCheck, ABeginningInTheMiddleNamesTheToolInTheSpindle) {
    std::string text = "G21 G90 G94\nT1 M6\nG0 Z5\nG0 X1 Y1\nT2\n";
    for (int n = 0; n < 10; ++n) {
        text += "G1 X" + std::to_string(n) + " F100\n";
    }
    text += "M6\nG0 X1\nM30\n";
    const Job job = job_of(text);
    const Job rest = job_from_line(job, 13, {.dialect = gcode::Dialect::grbl, .clearance = {}});
    EXPECT_EQ(tool_before_start(rest, checked(rest)),
              "Tool 1 must be in the spindle at line 13, and the Z zero must be set with it.");
}

TEST(ToolCheck, AToolThatIsMeasuredBeforeTheFirstLineIsAskedFor) {
    const Job job = job_of(two_tools, drivers::ToolChangeWay::probe);
    EXPECT_EQ(tool_before_start(job, checked(job)),
              "The tool with which the Z zero was set must be in the spindle: it is measured first.");
    EXPECT_TRUE(tool_changes(job, checked(job)).needs_zero);
    EXPECT_EQ(tool_before_start(job_of(two_tools), checked(job)), "");
}

TEST(ToolCheck, APlaceLowerThanTheStartIsNoSafeHeight) {
    EXPECT_THAT(faults(job_of("G21 G90\nG1 Z-1 F100\nX5\nT2 M6\nG0 Z5\n")),
                HasSubstr("test.ngc:4: the program has not raised Z"));
    EXPECT_EQ(faults(job_of("G21 G90\nG1 Z-1 F100\nX5\nG0 Z2\nT2 M6\nG0 Z5\n")), "");
}

TEST(ToolCheck, TheBoxIsThatOfTheCutsWithoutTheChanges) {
    const Job job = job_of("G21 G90 G94\nG0 Z5\nG1 X5 Y4 F100\nG0 Z6\nT2 M6\nG1 X8\nG0 Z6\nM30\n");
    const Job box = box_trace_job(job, checked(job));
    EXPECT_EQ(box.listing->text.find("M6"), std::string::npos);
    EXPECT_THAT(box.listing->text, HasSubstr("X-92.000"));
}

} // namespace
} // namespace millwright::jobs
