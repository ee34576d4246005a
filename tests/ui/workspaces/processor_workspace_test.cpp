#include "ui/workspaces/processor_workspace.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace millwright::actions {
namespace {

const std::string square = "G21 F600\nG1 X10\nG1 Y10\nG1 X0\nG1 Y0\nM2\n";

ProcessorWorkspace loaded(const std::string& text) {
    ProcessorWorkspace workspace;
    workspace.load(ProcessorSource::opened_file, text, "part.ngc");
    return workspace;
}

TEST(ProcessorWorkspace, ShowsInstructionsWithTheLinesThatTheyComeFrom) {
    const ProcessorWorkspace workspace = loaded(square);
    ASSERT_FALSE(workspace.failure());
    EXPECT_EQ(workspace.code().front().text, "MOV Vmax, 10");
    EXPECT_EQ(workspace.code().front().line, 2);
    EXPECT_EQ(workspace.code().back().text, "M02");
    EXPECT_EQ(workspace.code().back().line, 6);
    EXPECT_EQ(workspace.code_row(), 0);
    EXPECT_EQ(workspace.micro_address(workspace.micro_row()), 0);
    EXPECT_EQ(workspace.differences().size(), 4U);
}

TEST(ProcessorWorkspace, RunsAsFastAsAskedAndStopsAtTheEnd) {
    ProcessorWorkspace workspace = loaded(square);
    ProcessorChoice choice = workspace.choice();
    choice.clocks_per_second = 100.0;
    workspace.set(choice);
    workspace.run();
    EXPECT_TRUE(workspace.advance(0.5));
    EXPECT_EQ(workspace.debugger().state().clocks.total, 50);
    EXPECT_FALSE(workspace.advance(0.001)); // less than a clock
    choice.clocks_per_second = 0.0;
    workspace.set(choice); // speed alone compiles nothing anew
    EXPECT_EQ(workspace.debugger().state().clocks.total, 50);
    EXPECT_TRUE(workspace.advance(0.0));
    EXPECT_FALSE(workspace.running());
    EXPECT_EQ(workspace.halt(), cordic::Halt::stopped);
}

TEST(ProcessorWorkspace, TellsTheErrorOfAnotherFormatAtOnceAndKeepsMicroBreakpoints) {
    ProcessorWorkspace workspace = loaded("G21 F600\nG0 X10\nG3 X0 Y10 I-10 J0\nM2\n");
    workspace.toggle_micro_breakpoint(3);
    ProcessorChoice choice = workspace.choice();
    choice.format = cordic::binary64;
    workspace.set(choice);
    const double exact = workspace.report().position_error;
    choice.format = cordic::fixed_format(10, 10);
    workspace.set(choice);
    EXPECT_GT(workspace.report().position_error, 100.0 * exact);
    EXPECT_TRUE(workspace.debugger().micro_breakpoints().contains(3));
    EXPECT_EQ(workspace.debugger().state().clocks.total, 0);
}

// Three moves of 1 mm at 10 mm/s, 0.1 s each; a line and its MOV take about 100 clocks.
TEST(ProcessorWorkspace, TellsWhatComesTooLateAtASlowerClockAndStaysWhereItStands) {
    ProcessorWorkspace workspace = loaded("G21 F600\nG1 X1\nG1 X2\nG1 X3\nM2\n");
    workspace.step(ProcessorStep::instruction);
    const auto stands = workspace.debugger().state().clocks.total;
    EXPECT_GT(stands, 0);
    EXPECT_TRUE(workspace.report().late.empty());
    EXPECT_TRUE(workspace.sewing().late.empty());
    ProcessorChoice choice = workspace.choice();
    choice.clock_hz = 500.0; // 0.2 s a line
    workspace.set(choice);
    EXPECT_EQ(workspace.report().late, (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(workspace.sewing().late_computations, 3); // more than the 20 ms of a stitch
    EXPECT_EQ(workspace.sewing().late_moves, 0);
    choice.clock_hz = 8e6;
    choice.needle_rpm = 50'000.0; // 1 mm in 0.8 ms: 3750 turns per minute of the screw
    workspace.set(choice);
    EXPECT_TRUE(workspace.report().late.empty());
    EXPECT_EQ(workspace.sewing().late_computations, 0);
    EXPECT_EQ(workspace.sewing().late_moves, 3);
    EXPECT_EQ(workspace.debugger().state().clocks.total, stands);
}

/// Lines of 0.1 mm at 10 mm/s, to and fro.
std::string long_program(int lines) {
    std::string text = "G21 F600\n";
    for (int n = 0; n < lines; ++n) {
        text += n % 2 == 0 ? "G1 X0.1\n" : "G1 X0\n";
    }
    return text + "M2\n";
}

TEST(ProcessorWorkspace, FollowsALongProgramToItsEndInTheBackground) {
    constexpr int lines = 12'000; // 1.2 million clocks
    ProcessorWorkspace workspace = loaded(long_program(lines));
    EXPECT_EQ(workspace.set_points(), 12'000U);
    EXPECT_TRUE(workspace.follows());
    EXPECT_LT(workspace.report().published, lines);
    workspace.wait_idle();
    EXPECT_TRUE(workspace.advance(0.0));
    EXPECT_FALSE(workspace.follows());
    EXPECT_EQ(workspace.report().stop, cordic::Stop::halted);
    EXPECT_EQ(workspace.report().published, lines);
    EXPECT_EQ(workspace.differences().size(), workspace.set_points());
    EXPECT_EQ(workspace.sewing().stitches, lines);
    EXPECT_FALSE(workspace.advance(0.0));

    ProcessorChoice choice = workspace.choice();
    choice.clock_hz = 1000.0; // 0.1 s a line, for 0.01 s of motion
    workspace.set(choice);
    workspace.wait_idle();
    EXPECT_TRUE(workspace.advance(0.0));
    EXPECT_EQ(workspace.report().late.size(), workspace.set_points() - 1);
}

TEST(ProcessorWorkspace, ForgetsALongProgramForTheNextOne) {
    ProcessorWorkspace workspace = loaded(long_program(12'000));
    workspace.load(ProcessorSource::opened_file, square, "part.ngc");
    EXPECT_FALSE(workspace.follows());
    workspace.wait_idle();
    EXPECT_FALSE(workspace.advance(0.0));
    EXPECT_EQ(workspace.report().published, 4);
    EXPECT_EQ(workspace.differences().size(), 4U);
}

TEST(ProcessorWorkspace, RunsAProgramWithoutAnEndAndSaysThatItHasNone) {
    const ProcessorWorkspace workspace = loaded("G21 G90\nG0 X1\nG1 X5 F100\n");
    ASSERT_FALSE(workspace.failure()) << workspace.failure()->message;
    EXPECT_GT(workspace.set_points(), 0U);
    ASSERT_EQ(workspace.warnings().size(), 1U);
    EXPECT_EQ(workspace.warnings()[0].place.line, 0);
    EXPECT_EQ(workspace.warnings()[0].message,
              "the program does not end with M2, M30 or %; it was read to its last line");
    EXPECT_TRUE(loaded("G21\nG0 X1\nM2\n").warnings().empty());
}

TEST(ProcessorWorkspace, KeepsWhatIsWrongWithAProgramAndExecutesNothing) {
    ProcessorWorkspace workspace = loaded("G21\nG0 X1 C5\nM2\n");
    ASSERT_TRUE(workspace.failure());
    EXPECT_EQ(workspace.failure()->place.line, 2);
    EXPECT_EQ(workspace.failure()->place.column, 7);
    EXPECT_TRUE(workspace.code().empty());
    workspace.run();
    EXPECT_FALSE(workspace.running());
    EXPECT_TRUE(workspace.differences().empty());
    EXPECT_EQ(workspace.debugger().line(), 0);
    EXPECT_EQ(workspace.sewing().stitches, 0);
    workspace.load(ProcessorSource::opened_file, square, "part.ngc");
    EXPECT_FALSE(workspace.failure());
}

} // namespace
} // namespace millwright::actions
