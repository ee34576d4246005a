#include "core/drivers/virtual_machine/internal/virtual_axes.h"
#include "core/motion/planner.h"
#include "tests/core/jobs/router.h"
#include "tests/support/jobs.h"
#include "tests/support/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace millwright::drivers::internal {
namespace {

using gcode::SpindleTurning;
using program::BlockKind;
using program::PauseKind;
using test::router;
using ::testing::ElementsAre;

/// Axes that stand where the program begins, connected.
struct PausedAxesBench {
    jobs::Job job;
    Work work = test::work_of(job);
    VirtualAxes axes{job.program->start, job.machine};

    explicit PausedAxesBench(const std::string& text)
        : PausedAxesBench(jobs::planned_job(text, "part.ngc", router())) {}
    explicit PausedAxesBench(jobs::Job wanted) : job(std::move(wanted)) { axes.connect(); }

    [[nodiscard]] const program::Block& block(int n) const {
        return job.program->blocks[static_cast<std::size_t>(n)];
    }
    /// Until the axes rest; how long that took, s.
    double run_until_rest() {
        double time = 0.0;
        for (constexpr double tick = 0.001; axes.moving(); time += tick) {
            axes.advance(tick);
        }
        return time;
    }
};

constexpr const char* stops = "G21 G90 G64 P0.1\n"
                              "G1 X10 F3000\n"
                              "M0\n"
                              "S1000 M3\n"
                              "X20 Y3\n"
                              "M1\n"
                              "X30\n"
                              "M60\n"
                              "T7 M6\n"
                              "X40\n"
                              "M30\n";

std::vector<std::string> reasons(PausedAxesBench& bench) {
    std::vector<std::string> found;
    bench.axes.start(bench.work);
    for (bench.run_until_rest(); bench.axes.status().state == DriverState::holding; bench.run_until_rest()) {
        found.push_back(bench.axes.status().message);
        bench.axes.resume();
    }
    EXPECT_EQ(bench.axes.status().state, DriverState::idle);
    EXPECT_EQ(bench.axes.status().message, "");
    EXPECT_EQ(bench.axes.status().executed_blocks, bench.job.program->block_count());
    return found;
}

TEST(VirtualAxesPauses, SayWhatTheyWaitFor) {
    PausedAxesBench bench(stops);
    EXPECT_THAT(reasons(bench),
                ElementsAre("program stop at line 3: M0",
                            "pallet change at line 8: M60",
                            "change to tool 7 at line 9: M6"));
}

TEST(VirtualAxesPauses, StopAtM1OnlyIfThatIsSwitchedOn) {
    PausedAxesBench bench(stops);
    bench.axes.set_optional_stop(true);
    EXPECT_THAT(reasons(bench),
                ElementsAre("program stop at line 3: M0",
                            "optional stop at line 6: M1",
                            "pallet change at line 8: M60",
                            "change to tool 7 at line 9: M6"));
}

TEST(VirtualAxesPauses, RestWhereTheBlockBeforeEndsWithNothingOfWhatFollows) {
    PausedAxesBench bench(stops);
    bench.axes.start(bench.work);
    bench.run_until_rest();
    DriverStatus status = bench.axes.status();
    EXPECT_EQ(status.state, DriverState::holding);
    EXPECT_EQ(status.activity, Activity::program);
    EXPECT_EQ(status.position, bench.block(0).target);
    EXPECT_EQ(status.velocity.norm(), 0.0);
    EXPECT_EQ(status.executed_blocks, 1);
    EXPECT_EQ(bench.block(status.block).kind, BlockKind::pause);
    EXPECT_EQ(status.spindle, SpindleTurning::stopped);
    bench.axes.hold(); // changes nothing
    EXPECT_EQ(bench.axes.status().message, "program stop at line 3: M0");
    bench.axes.resume();
    EXPECT_EQ(bench.axes.status().state, DriverState::running);
    bench.axes.advance(0.001);
    EXPECT_EQ(bench.axes.status().spindle, SpindleTurning::clockwise);
    EXPECT_EQ(bench.axes.status().message, "");
}

TEST(VirtualAxesPauses, TakeNoTimeOfTheMotion) {
    PausedAxesBench bench(stops);
    bench.axes.start(bench.work);
    double time = bench.run_until_rest();
    while (bench.axes.status().state == DriverState::holding) {
        bench.axes.resume();
        time += bench.run_until_rest();
    }
    EXPECT_NEAR(time, bench.work.trajectory->duration(), 0.005);
}

TEST(VirtualAxesPauses, AreLeftForGoodByAStop) {
    PausedAxesBench bench(stops);
    bench.axes.start(bench.work);
    bench.run_until_rest();
    bench.axes.stop();
    EXPECT_EQ(bench.axes.status().state, DriverState::stopped);
    EXPECT_EQ(bench.axes.status().message, "");
    EXPECT_EQ(bench.axes.status().executed_blocks, 1);
    bench.axes.resume();
    EXPECT_EQ(bench.axes.status().state, DriverState::stopped);
}

TEST(VirtualAxesPauses, WaitAtTheBeginAtTheEndAndOneAfterAnother) {
    PausedAxesBench bench("G21 G90\nM0\nM0\nG1 X5 F1000\nM0\nT2 M6\nM0\nM30\n");
    EXPECT_THAT(reasons(bench),
                ElementsAre("program stop at line 2: M0",
                            "program stop at line 3: M0",
                            "program stop at line 5: M0",
                            "change to tool 2 at line 6: M6",
                            "program stop at line 7: M0"));
}

/// Pauses everywhere, also in long programs that are planned on while they run.
jobs::Job job_with_pauses(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> die(0, 11);
    const auto machine = test::machine("rotary-tilt-listing");
    const program::Program moves = test::random_program(machine, 300, seed);
    program::Program program = test::empty_program(machine);
    for (const program::Block& block : moves.blocks) {
        program.blocks.push_back(block);
        for (int more = die(random); more >= 10; more = die(random)) {
            test::add_block(program, BlockKind::pause);
            program.blocks.back().text = "look";
        }
    }
    return test::job_of(std::move(program));
}

TEST(VirtualAxesPauses, AreNeverPassedWhateverAPersonDoes) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        PausedAxesBench bench(job_with_pauses(seed));
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> act(0, 39);
        std::uniform_real_distribution<double> tick(0.0, 0.05);
        int expected = 0; // pauses that were waited at
        int allowed = 0;  // blocks up to the next pause
        const auto to_next_pause = [&](int from) {
            while (from < bench.job.program->block_count() && bench.block(from).kind != BlockKind::pause) {
                ++from;
            }
            return from;
        };
        allowed = to_next_pause(0);
        bench.axes.start(bench.work);
        for (DriverStatus now = bench.axes.status(); now.state != DriverState::idle;
             now = bench.axes.status()) {
            ASSERT_LE(now.executed_blocks, allowed) << "seed " << seed;
            const bool waits = now.state == DriverState::holding && !now.message.empty();
            if (waits) {
                ASSERT_EQ(now.executed_blocks, allowed) << "seed " << seed;
                ASSERT_EQ(now.position, bench.block(allowed).target) << "seed " << seed;
                ++expected;
                allowed = to_next_pause(allowed + 1);
            }
            switch (act(random)) {
            case 0:
                bench.axes.hold();
                break;
            case 1:
                bench.axes.set_overrides({.feed = 10 + 5 * act(random), .rapid = 100, .spindle = 100});
                break;
            case 2:
                bench.axes.set_single_block(true);
                break;
            case 3:
                bench.axes.set_single_block(false);
                break;
            case 4:
                bench.axes.set_optional_stop(act(random) < 20);
                break;
            default:
                break;
            }
            if (waits || (bench.axes.status().state == DriverState::holding && act(random) < 20)) {
                bench.axes.resume();
            }
            bench.axes.advance(tick(random));
        }
        EXPECT_EQ(allowed, bench.job.program->block_count());
        EXPECT_EQ(expected,
                  std::ranges::count(bench.job.program->blocks, BlockKind::pause, &program::Block::kind));
    }
}

} // namespace
} // namespace millwright::drivers::internal
