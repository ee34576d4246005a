// A plot beside what else the window has: an open program, the project, a job.
#include "tests/ui/person/plot_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

namespace millwright::panels {
namespace {

using actions::FrameState;
using actions::Workspace;
using test::PlotPerson;
using testing::HasSubstr;

TEST(PlotWorkspace, TheTimelineTellsOfAJobThatIsNoneOfThePlots) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.app().view_state().workspace = Workspace::machine;
    bench.person.open("assets/projects/dome.json");
    bench.settle();
    bench.person.app().run("machine.run");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.app().look().job.report.has_value(); }));
    bench.person.app().view_state().workspace = Workspace::plot;
    bench.person.frames(3);
    ASSERT_TRUE(bench.person.app().look().job.running);
    EXPECT_THAT(bench.person.refusal("timeline/timeline/play"), HasSubstr("A job is running"));
    bench.person.keep("plot-beside-a-job");
    bench.person.app().run("machine.stop");
    EXPECT_TRUE(bench.person.live_until([&] { return !bench.person.app().look().job.running; }));
}

TEST(PlotWorkspace, ThePlotPlaysAgainWhenOneComesBackFromTheMachine) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const double duration = bench.person.app().look().duration();
    ASSERT_GT(duration, 0.0);
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    ASSERT_EQ(bench.person.app().look().opened->file, bench.folder / "everyday.ngc");
    bench.person.app().view_state().workspace = Workspace::plot;
    bench.settle();
    EXPECT_TRUE(bench.person.sees("layers/position/gone"));
    EXPECT_EQ(bench.person.app().look().opened->file, bench.made().program->name);
    EXPECT_NEAR(bench.person.app().look().duration(), duration, 1e-9);
    bench.person.click("timeline/timeline/last");
    bench.person.frames(3);
    EXPECT_NEAR(bench.person.app().look().time(), duration, 1e-6);
    bench.person.keep("plot-back");
    bench.person.app().view_state().workspace = Workspace::machine; // has what was sent there
    bench.settle();
    EXPECT_EQ(bench.person.app().look().opened->file, bench.folder / "everyday.ngc");
}

// It was read anew, from its first line on, and a long one took its time each time.
TEST(PlotWorkspace, AnOpenProgramStaysAsItIsWhileAPlotIsLookedAt) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.app().view_state().workspace = Workspace::program; // where G-code is no plot
    bench.person.app().open("assets/samples/thesis-arc.ngc");
    bench.settle();
    bench.person.app().run("play.line_forward");
    bench.person.app().run("play.forward");
    bench.person.frames(3);
    ASSERT_TRUE(bench.person.app().look().file_place());
    const auto program = bench.person.app().look().opened;
    const double time = bench.person.app().look().time();
    const gcode::Step step = bench.person.app().look().file_place()->step;
    ASSERT_TRUE(program->motion);
    ASSERT_GT(time, 0.0);
    bench.person.app().view_state().workspace = Workspace::plot;
    bench.settle();
    EXPECT_EQ(bench.person.app().look().opened->file, "everyday.ngc");
    EXPECT_EQ(bench.person.app().look().opened_file, program) << "it is not read anew";
    bench.person.click("timeline/timeline/last");
    bench.person.frames(3);
    const double at_plot = bench.person.app().look().time();
    bench.person.app().view_state().workspace = Workspace::program;
    bench.settle();
    const FrameState after = bench.person.app().look();
    EXPECT_EQ(after.opened, program);
    EXPECT_DOUBLE_EQ(after.time(), time);
    EXPECT_EQ(after.file_place()->step, step);
    bench.person.app().view_state().workspace = Workspace::plot;
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.person.app().look().time(), at_plot) << "and the plot stays where it stood";
}

// Run would have sent the program of a plot that a person never sent to the machine.
TEST(PlotWorkspace, TheProgramOfAPlotIsNoneOfTheMachinesBeforeItIsSentThere) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    ASSERT_TRUE(bench.person.app().look().in_file());
    bench.person.app().view_state().workspace = Workspace::machine;
    bench.settle();
    const FrameState now = bench.person.app().look();
    EXPECT_FALSE(now.in_file());
    EXPECT_FALSE(now.opened);
    EXPECT_EQ(now.program(), now.plan->plan.program);
}

// A job that begins at a line of the open program must not become one of the plot's.
TEST(PlotWorkspace, ALineToStartAtStaysOneOfTheOpenProgram) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.app().view_state().workspace = Workspace::program;
    bench.person.app().open("assets/samples/thesis-arc.ngc");
    bench.settle();
    const auto program = bench.person.app().look().opened;
    bench.person.app().view_state().workspace = Workspace::machine;
    const actions::StartAt start{.on = true, .line = 4, .clearance = std::nullopt, .hash = {}};
    bench.person.app().view_state().start_at = start;
    bench.settle();
    ASSERT_TRUE(bench.person.app().look().approach);
    EXPECT_EQ(bench.person.app().look().approach->wish.source.opened, program);
    bench.person.app().view_state().workspace = Workspace::plot;
    bench.settle();
    EXPECT_FALSE(bench.person.app().look().approach);
    bench.person.app().view_state().workspace = Workspace::machine;
    bench.settle();
    EXPECT_EQ(bench.person.app().view_state().start_at, start);
    ASSERT_TRUE(bench.person.app().look().approach);
    EXPECT_EQ(bench.person.app().look().approach->wish.source.opened, program);
}

TEST(PlotWorkspace, ItsProgramIsQueuedFromTheMachineWorkspaceAlone) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const actions::Action& add = bench.person.app().catalogue().find("queue.add");
    EXPECT_THAT(add.permission(bench.person.app().look()).reason,
                HasSubstr("in the Machine workspace first"));
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    EXPECT_TRUE(add.permission(bench.person.app().look()).allowed);
}

// F9 opened the machine with the project's program, and pressed again it ran that.
TEST(PlotWorkspace, RunIsNotForAPlotThatWasNotSentToTheMachine) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const actions::Action& run = bench.person.app().catalogue().find("machine.run");
    EXPECT_THAT(run.permission(bench.person.app().look()).reason,
                HasSubstr("in the Machine workspace first"));
    bench.person.press_key(render::Key::f9);
    bench.person.frames(3);
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::plot);
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    EXPECT_TRUE(run.permission(bench.person.app().look()).allowed);
}

} // namespace
} // namespace millwright::panels
