#include "ui/actions/processor_bench.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace millwright::actions {
namespace {

const std::string square = "G21 F600\nG1 X10\nG1 Y10\nG1 X0\nG1 Y0\nM2\n";

ProcessorBench loaded(const std::string& text) {
    ProcessorBench bench;
    bench.load(ProcessorSource::opened_file, text, "part.ngc");
    return bench;
}

TEST(ProcessorBench, ShowsInstructionsWithTheLinesThatTheyComeFrom) {
    const ProcessorBench bench = loaded(square);
    ASSERT_FALSE(bench.failure());
    EXPECT_EQ(bench.code().front().text, "MOV Vmax, 10");
    EXPECT_EQ(bench.code().front().line, 2);
    EXPECT_EQ(bench.code().back().text, "M02");
    EXPECT_EQ(bench.code().back().line, 6);
    EXPECT_EQ(bench.code_row(), 0);
    EXPECT_EQ(bench.micro_address(bench.micro_row()), 0);
    EXPECT_EQ(bench.differences().size(), 4U);
}

TEST(ProcessorBench, RunsAsFastAsAskedAndStopsAtTheEnd) {
    ProcessorBench bench = loaded(square);
    ProcessorChoice choice = bench.choice();
    choice.clocks_a_second = 100.0;
    bench.set(choice);
    bench.run();
    EXPECT_TRUE(bench.advance(0.5));
    EXPECT_EQ(bench.debugger().state().clocks.total, 50);
    EXPECT_FALSE(bench.advance(0.001)); // less than a clock
    choice.clocks_a_second = 0.0;
    bench.set(choice); // speed alone compiles nothing anew
    EXPECT_EQ(bench.debugger().state().clocks.total, 50);
    EXPECT_TRUE(bench.advance(0.0));
    EXPECT_FALSE(bench.running());
    EXPECT_EQ(bench.halt(), cordic::Halt::stopped);
}

TEST(ProcessorBench, TellsTheErrorOfAnotherFormatAtOnceAndKeepsMicroBreakpoints) {
    ProcessorBench bench = loaded("G21 F600\nG0 X10\nG3 X0 Y10 I-10 J0\nM2\n");
    bench.toggle_micro_breakpoint(3);
    ProcessorChoice choice = bench.choice();
    choice.format = cordic::binary64;
    bench.set(choice);
    const double exact = bench.report().position_error;
    choice.format = cordic::fixed_format(10, 10);
    bench.set(choice);
    EXPECT_GT(bench.report().position_error, 100.0 * exact);
    EXPECT_TRUE(bench.debugger().micro_breakpoints().contains(3));
    EXPECT_EQ(bench.debugger().state().clocks.total, 0);
}

// Three moves of 1 mm at 10 mm/s, 0.1 s each; a line and its MOV take about 100 clocks.
TEST(ProcessorBench, TellsWhatComesTooLateAtASlowerClockAndStaysWhereItStands) {
    ProcessorBench bench = loaded("G21 F600\nG1 X1\nG1 X2\nG1 X3\nM2\n");
    bench.step(ProcessorStep::instruction);
    const auto stands = bench.debugger().state().clocks.total;
    EXPECT_GT(stands, 0);
    EXPECT_TRUE(bench.report().late.empty());
    EXPECT_TRUE(bench.sewing().late.empty());
    ProcessorChoice choice = bench.choice();
    choice.clock_hz = 500.0; // 0.2 s a line
    bench.set(choice);
    EXPECT_EQ(bench.report().late, (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(bench.sewing().late_computations, 3); // more than the 20 ms of a stitch
    EXPECT_EQ(bench.sewing().late_moves, 0);
    choice.clock_hz = 8e6;
    choice.needle_rpm = 50'000.0; // 1 mm in 0.8 ms: 3750 turns a minute of the screw
    bench.set(choice);
    EXPECT_TRUE(bench.report().late.empty());
    EXPECT_EQ(bench.sewing().late_computations, 0);
    EXPECT_EQ(bench.sewing().late_moves, 3);
    EXPECT_EQ(bench.debugger().state().clocks.total, stands);
}

/// Lines of 0.1 mm at 10 mm/s, to and fro.
std::string long_program(int lines) {
    std::string text = "G21 F600\n";
    for (int n = 0; n < lines; ++n) {
        text += n % 2 == 0 ? "G1 X0.1\n" : "G1 X0\n";
    }
    return text + "M2\n";
}

TEST(ProcessorBench, FollowsALongProgramToItsEndInTheBackground) {
    constexpr int lines = 12'000; // 1.2 million clocks
    ProcessorBench bench = loaded(long_program(lines));
    EXPECT_EQ(bench.set_points(), 12'000U);
    EXPECT_TRUE(bench.follows());
    EXPECT_LT(bench.report().published, lines);
    bench.wait_idle();
    EXPECT_TRUE(bench.advance(0.0));
    EXPECT_FALSE(bench.follows());
    EXPECT_EQ(bench.report().stop, cordic::Stop::halted);
    EXPECT_EQ(bench.report().published, lines);
    EXPECT_EQ(bench.differences().size(), bench.set_points());
    EXPECT_EQ(bench.sewing().stitches, lines);
    EXPECT_FALSE(bench.advance(0.0));

    ProcessorChoice choice = bench.choice();
    choice.clock_hz = 1000.0; // 0.1 s a line, for 0.01 s of motion
    bench.set(choice);
    bench.wait_idle();
    EXPECT_TRUE(bench.advance(0.0));
    EXPECT_EQ(bench.report().late.size(), bench.set_points() - 1);
}

TEST(ProcessorBench, ForgetsALongProgramForTheNextOne) {
    ProcessorBench bench = loaded(long_program(12'000));
    bench.load(ProcessorSource::opened_file, square, "part.ngc");
    EXPECT_FALSE(bench.follows());
    bench.wait_idle();
    EXPECT_FALSE(bench.advance(0.0));
    EXPECT_EQ(bench.report().published, 4);
    EXPECT_EQ(bench.differences().size(), 4U);
}

TEST(ProcessorBench, KeepsWhatIsWrongWithAProgramAndExecutesNothing) {
    ProcessorBench bench = loaded("G21\nG0 X1 C5\nM2\n");
    ASSERT_TRUE(bench.failure());
    EXPECT_EQ(bench.failure()->place.line, 2);
    EXPECT_EQ(bench.failure()->place.column, 7);
    EXPECT_TRUE(bench.code().empty());
    bench.run();
    EXPECT_FALSE(bench.running());
    EXPECT_TRUE(bench.differences().empty());
    EXPECT_EQ(bench.debugger().line(), 0);
    EXPECT_EQ(bench.sewing().stitches, 0);
    bench.load(ProcessorSource::opened_file, square, "part.ngc");
    EXPECT_FALSE(bench.failure());
}

} // namespace
} // namespace millwright::actions
