#include "core/cordic/debugger.h"

#include "core/cordic/assembler.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::cordic {
namespace {

constexpr std::int64_t debugger_clocks = 100'000;

/// Two lines of a program: a line to (6, 8), an arc of three chords about (0, 0).
Debugger debugger() {
    const auto [image, lines, errors, warnings] = assemble(R"(
        MOV Vmax, 1
        MOV Amax, 2
        MOV XI, 6
        MOV YJ, 8
        G01
        MOV XI, 0
        MOV YJ, 0
        MOV Dz, 0.3
        MOV N, 3
        G03
        HLT
    )",
                                                           "two.asm",
                                                           binary64);
    EXPECT_TRUE(errors.empty());
    return {Processor({}, image), {{0, 1}, {36, 1}, {37, 2}}};
}

TEST(Debugger, StepsByClockMicroInstructionInstructionAndBlock) {
    Debugger now = debugger();
    EXPECT_EQ(now.step_clock(), Halt::done);
    EXPECT_EQ(now.state().clocks.total, 1);
    EXPECT_EQ(now.step_instruction(debugger_clocks), Halt::done);
    EXPECT_EQ(now.state().instructions, 1);
    EXPECT_EQ(now.instruction(), 9);
    EXPECT_EQ(now.line(), 1);
    EXPECT_EQ(now.step_block(debugger_clocks), Halt::done);
    EXPECT_EQ(now.line(), 2);
    EXPECT_EQ(now.instruction(), 37);
    EXPECT_EQ(now.processor().published().size(), 1U);
    EXPECT_EQ(now.step_block(debugger_clocks), Halt::stopped);
    EXPECT_EQ(now.state().stop, Stop::halted);
    EXPECT_EQ(now.step_clock(), Halt::stopped);
}

TEST(Debugger, TakesALoopOfOneMicroInstructionAsOneStep) {
    Debugger now = debugger();
    const auto& labels = now.processor().microprogram().labels;
    now.toggle_micro_breakpoint(labels.at("S1"));
    EXPECT_EQ(now.run(debugger_clocks), Halt::breakpoint);
    EXPECT_EQ(now.state().sequencer.address, labels.at("S1"));
    const auto before = now.state().clocks.total;
    EXPECT_EQ(now.step_micro_instruction(debugger_clocks), Halt::done);
    EXPECT_EQ(now.state().clocks.total - before, 29);
    EXPECT_EQ(now.before().clocks.total, before);
}

TEST(Debugger, StopsBeforeAnInstructionThatHasABreakpointAndGoesOnFromIt) {
    Debugger now = debugger();
    now.toggle_breakpoint(36);
    EXPECT_EQ(now.run(debugger_clocks), Halt::breakpoint);
    EXPECT_EQ(now.instruction(), 36);
    EXPECT_TRUE(now.processor().published().empty());
    EXPECT_EQ(now.run(debugger_clocks), Halt::stopped);
    EXPECT_EQ(now.processor().published().size(), 4U);
    now.reset();
    EXPECT_EQ(now.run(debugger_clocks), Halt::breakpoint);
    now.toggle_breakpoint(36);
    now.reset();
    EXPECT_EQ(now.run_to(37, debugger_clocks), Halt::done);
    EXPECT_EQ(now.run_to_set_point(debugger_clocks), Halt::done);
    EXPECT_EQ(now.processor().published().size(), 2U);
    EXPECT_EQ(now.run(5), Halt::limit);
}

TEST(Debugger, ShowsThePassThatIsUnderWayStepByStep) {
    Debugger now = debugger();
    EXPECT_TRUE(now.iterations().points.empty());
    now.toggle_micro_breakpoint(now.processor().microprogram().labels.at("S1"));
    now.run(debugger_clocks);
    const IterationTrace start = now.iterations();
    EXPECT_EQ(start.mode, Mode::vectoring);
    ASSERT_EQ(start.points.size(), 1U);
    // (6, 8) folded by -90 degrees is (8, -6).
    EXPECT_EQ(start.points[0].x, 8.0);
    EXPECT_EQ(start.points[0].y, -6.0);
    EXPECT_NEAR(start.points[0].angle_error, std::atan2(6.0, 8.0), 1e-15);
    for (int n = 0; n < 12; ++n) {
        now.step_clock();
    }
    const IterationTrace some = now.iterations();
    ASSERT_EQ(some.points.size(), 13U);
    const auto word = [&](Word w) { return now.processor().number(w); };
    EXPECT_EQ(some.points.back().x, word(now.state().path.x)); // the replay has the processor's own bits
    EXPECT_EQ(some.points.back().y, word(now.state().path.y));
    EXPECT_EQ(some.points.back().z, word(now.state().path.z));
    now.toggle_micro_breakpoint(now.processor().microprogram().labels.at("S1"));
    now.run_to_set_point(debugger_clocks);
    const IterationTrace whole = now.iterations();
    EXPECT_EQ(whole.mode, Mode::rotation);
    ASSERT_EQ(whole.points.size(), 1U + 29U + 8U);
    EXPECT_LT(whole.points[29].angle_error, 6e-8);
    EXPECT_TRUE(whole.points[30].corrects);
    EXPECT_FALSE(whole.points[29].corrects);
    EXPECT_EQ(whole.points.back().x, word(now.state().path.x));
}

} // namespace
} // namespace millwright::cordic
