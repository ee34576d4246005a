#include "core/drivers/virtual_machine/internal/virtual_axes.h"

#include "core/base/error.h"
#include "core/motion/hold.h"
#include "tests/support/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace millwright::drivers::internal {
namespace {

using kinematics::AxisPositions;

/// Axes at zero, connected, about to execute the dome.
struct VirtualAxesBench {
    jobs::Job job = test::dome_job();
    Work work = test::work_of(job);
    VirtualAxes axes{job.program->start};

    VirtualAxesBench() { axes.connect(); }
    [[nodiscard]] double duration() const { return work.trajectory->duration(); }
};

TEST(VirtualAxes, FollowTheTrajectoryToItsEnd) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    double time = 0.0;
    while (bench.axes.moving()) {
        const DriverStatus status = bench.axes.status();
        EXPECT_EQ(status.state, DriverState::running);
        EXPECT_LT((status.position - bench.work.trajectory->at(time).position).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_NEAR(status.planned_time, time, 1e-6);
        bench.axes.advance(0.25);
        time += 0.25;
    }
    const DriverStatus status = bench.axes.status();
    EXPECT_EQ(status.state, DriverState::idle);
    EXPECT_EQ(status.executed_blocks, bench.job.program->block_count());
    EXPECT_EQ(status.position, bench.job.program->blocks.back().target);
    EXPECT_NEAR(time, bench.duration(), 0.25);
}

TEST(VirtualAxes, CountABlockOnlyWhenItIsCompletelyExecuted) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    for (double time = 0.0; time < bench.duration(); time += 0.1) {
        const int executed = bench.axes.status().executed_blocks;
        if (executed > 0) {
            EXPECT_LE(bench.work.trajectory->end_of(executed - 1), time + 1e-9);
        }
        EXPECT_GE(bench.work.trajectory->end_of(executed), time - 1e-9);
        bench.axes.advance(0.1);
    }
}

TEST(VirtualAxes, GoSlowerAndFasterAsTheyAreTold) {
    const auto time_with = [](const Overrides& overrides) {
        VirtualAxesBench bench;
        bench.axes.start(bench.work);
        bench.axes.set_overrides(overrides);
        EXPECT_EQ(bench.axes.status().overrides, overrides);
        double time = 0.0;
        for (; bench.axes.moving(); time += 0.1) {
            bench.axes.advance(0.1);
        }
        EXPECT_EQ(bench.axes.status().position, bench.job.program->blocks.back().target);
        EXPECT_EQ(bench.axes.status().executed_blocks, bench.job.program->block_count());
        return time;
    };
    const double normal = time_with({});
    EXPECT_NEAR(normal, VirtualAxesBench().duration(), 0.2);
    EXPECT_GT(time_with({.feed = 50}), 1.5 * normal);
    EXPECT_LT(time_with({.feed = 200}), 0.8 * normal);
    EXPECT_GT(time_with({.rapid = 10}), normal);
}

TEST(VirtualAxes, PlanALongProgramOnWhileTheyExecuteIt) {
    const auto machine = test::machine("rotary-tilt-listing");
    program::Program program = test::empty_program(machine);
    AxisPositions q = program.start;
    for (int n = 1; n <= 7000; ++n) {
        q[0] += n / 100 % 2 == 0 ? 0.5 : -0.5;
        q[1] += 0.01;
        test::add_move(program, q, 0.02);
    }
    const jobs::Job job = test::job_of(program);
    const Work work = test::work_of(job);
    VirtualAxes axes(program.start);
    axes.connect();
    axes.start(work);
    axes.advance(1.0);
    axes.set_overrides({.feed = 150});
    const double expected = motion::go_on(*work.trajectory, 1.0, {1.5, 1.0}).duration();
    axes.advance(expected - 0.01);
    EXPECT_TRUE(axes.moving());
    axes.advance(0.011);
    EXPECT_FALSE(axes.moving());
    EXPECT_EQ(axes.status().executed_blocks, program.block_count());
    EXPECT_EQ(axes.status().position, q);
}

TEST(VirtualAxes, KeepOverridesThroughAHoldAndForgetThemWithTheProgram) {
    VirtualAxesBench bench;
    EXPECT_THROW(VirtualAxes(bench.job.program->start).set_overrides({}), Error);
    bench.axes.start(bench.work);
    bench.axes.set_overrides({.feed = 1000, .rapid = 0, .spindle = -5});
    EXPECT_EQ(bench.axes.status().overrides, (Overrides{.feed = 200, .rapid = 1, .spindle = 1}));
    bench.axes.advance(1.0);
    bench.axes.hold();
    bench.axes.set_overrides({.feed = 20});
    bench.axes.advance(10.0);
    EXPECT_FALSE(bench.axes.moving()) << "an override is no resume";
    bench.axes.resume();
    EXPECT_EQ(bench.axes.status().overrides.feed, 20);
    bench.axes.advance(1e6);
    const auto back =
        motion::plan(*bench.job.program, *bench.job.machine, {}, {}, bench.axes.status().position);
    bench.axes.start(
        {bench.job.program, std::make_shared<const motion::Trajectory>(back), bench.job.listing});
    EXPECT_EQ(bench.axes.status().overrides, Overrides{});
}

/// Where the planned path has `block` end: in a rounded corner that is beside the block's target.
AxisPositions end_of(const VirtualAxesBench& bench, int block) {
    return bench.work.trajectory->at(bench.work.trajectory->end_of(block)).position;
}

/// Moves on until the axes rest.
DriverStatus at_rest(VirtualAxes& axes) {
    axes.advance(1e6);
    return axes.status();
}

TEST(VirtualAxes, RestBehindEachMoveBlockByBlock) {
    VirtualAxesBench bench;
    bench.axes.set_single_block(true);
    bench.axes.start(bench.work);
    const auto& blocks = bench.job.program->blocks;
    int rests = 0;
    int executed = 0;
    DriverStatus now = at_rest(bench.axes);
    for (; now.state == DriverState::holding; now = at_rest(bench.axes)) {
        ++rests;
        ASSERT_GT(now.executed_blocks, executed);
        int moves = 0;
        for (int n = executed; n < now.executed_blocks; ++n) {
            moves += blocks[static_cast<std::size_t>(n)].moves() ? 1 : 0;
        }
        EXPECT_EQ(moves, 1);
        executed = now.executed_blocks;
        EXPECT_LT((now.position - end_of(bench, executed - 1)).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LE(now.velocity.cwiseAbs().maxCoeff(), 0.0);
        EXPECT_NEAR(now.planned_time, bench.work.trajectory->start_of(executed), 1e-9);
        bench.axes.resume();
    }
    EXPECT_EQ(now.state, DriverState::idle);
    EXPECT_EQ(now.executed_blocks, bench.job.program->block_count());
    const auto moves = std::ranges::count_if(blocks, &program::Block::moves);
    EXPECT_GE(rests, moves - 1);
    EXPECT_LE(rests, moves);
}

TEST(VirtualAxes, GoBlockByBlockFromAnyMomentOnAndThroughAgain) {
    std::mt19937 random(11);
    for (int run = 0; run < 50; ++run) {
        VirtualAxesBench bench;
        bench.axes.start(bench.work);
        bench.axes.advance(std::uniform_real_distribution(0.0, bench.duration())(random));
        const int before = bench.axes.status().executed_blocks;
        bench.axes.set_single_block(true);
        DriverStatus now = at_rest(bench.axes);
        if (now.state == DriverState::holding) {
            const AxisPositions end = end_of(bench, now.executed_blocks - 1);
            EXPECT_LT((now.position - end).cwiseAbs().maxCoeff(), 1e-9);
            EXPECT_GE(now.executed_blocks, before);
            bench.axes.set_single_block(false);
            EXPECT_FALSE(bench.axes.moving()) << "no longer block by block is no resume";
            if (run % 2 == 0) {
                bench.axes.stop();
                EXPECT_EQ(bench.axes.status().state, DriverState::stopped);
                EXPECT_EQ(bench.axes.status().executed_blocks, now.executed_blocks);
                continue;
            }
            bench.axes.resume();
            now = at_rest(bench.axes);
        }
        EXPECT_EQ(now.state, DriverState::idle);
        EXPECT_EQ(now.position, bench.job.program->blocks.back().target);
    }
}

TEST(VirtualAxes, HoldOnThePathAndResumeToTheSameEnd) {
    std::mt19937 random(7);
    VirtualAxesBench first;
    std::uniform_real_distribution<double> when(0.0, first.duration());
    for (int run = 0; run < 50; ++run) {
        VirtualAxesBench bench;
        bench.axes.start(bench.work);
        bench.axes.advance(when(random));
        bench.axes.hold();
        EXPECT_EQ(bench.axes.status().state, DriverState::holding);
        bench.axes.advance(run % 2 == 0 ? 10.0 : 0.03);
        const AxisPositions held = bench.axes.status().position;
        if (run % 2 == 0) {
            EXPECT_FALSE(bench.axes.moving());
            bench.axes.advance(100.0);
            EXPECT_EQ(bench.axes.status().position, held);
        }
        bench.axes.resume();
        EXPECT_LT((bench.axes.status().position - held).cwiseAbs().maxCoeff(), 1e-9);
        bench.axes.advance(1e6);
        EXPECT_EQ(bench.axes.status().state, DriverState::idle);
        EXPECT_EQ(bench.axes.status().executed_blocks, bench.job.program->block_count());
        EXPECT_EQ(bench.axes.status().position, bench.job.program->blocks.back().target);
    }
}

TEST(VirtualAxes, StopInTheTimeThatTheirAccelerationNeedsAndDoNotResume) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    bench.axes.advance(bench.duration() / 2.0);
    bench.axes.stop();
    EXPECT_EQ(bench.axes.status().state, DriverState::stopping);
    bench.axes.advance(2.0);
    const DriverStatus stopped = bench.axes.status();
    EXPECT_EQ(stopped.state, DriverState::stopped);
    EXPECT_LT(stopped.executed_blocks, bench.job.program->block_count());
    bench.axes.resume();
    bench.axes.hold();
    bench.axes.advance(100.0);
    EXPECT_EQ(bench.axes.status().state, DriverState::stopped);
    EXPECT_EQ(bench.axes.status().position, stopped.position);
}

TEST(VirtualAxes, StopFromAHoldWithoutMovingAgain) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    bench.axes.advance(3.0);
    bench.axes.hold();
    bench.axes.advance(10.0);
    const AxisPositions held = bench.axes.status().position;
    bench.axes.stop();
    EXPECT_EQ(bench.axes.status().state, DriverState::stopped);
    bench.axes.advance(10.0);
    EXPECT_EQ(bench.axes.status().position, held);
}

TEST(VirtualAxes, FreezeAtAnEmergencyStopAndStartNothingBeforeTheReset) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    bench.axes.advance(3.0);
    const AxisPositions there = bench.axes.status().position;
    bench.axes.emergency_stop("pressed");
    EXPECT_EQ(bench.axes.status().state, DriverState::alarm);
    EXPECT_EQ(bench.axes.status().message, "pressed");
    bench.axes.advance(10.0);
    bench.axes.resume();
    bench.axes.advance(10.0);
    EXPECT_EQ(bench.axes.status().position, there);
    EXPECT_THROW(bench.axes.start(bench.work), Error);
    bench.axes.reset();
    EXPECT_EQ(bench.axes.status().state, DriverState::idle);
    EXPECT_EQ(bench.axes.status().position, there);
}

TEST(VirtualAxes, RefuseAMotionThatBeginsElsewhere) {
    VirtualAxesBench bench;
    bench.axes.start(bench.work);
    bench.axes.advance(3.0);
    bench.axes.stop();
    bench.axes.advance(3.0);
    EXPECT_THROW(bench.axes.start(bench.work), Error);
    const auto from_here =
        motion::plan(*bench.job.program, *bench.job.machine, {}, {}, bench.axes.status().position);
    bench.axes.start(
        {bench.job.program, std::make_shared<const motion::Trajectory>(from_here), bench.job.listing});
    bench.axes.advance(1e6);
    EXPECT_EQ(bench.axes.status().position, bench.job.program->blocks.back().target);
}

TEST(VirtualAxes, RefuseAProgramWhileOneRunsOrWithoutALink) {
    VirtualAxesBench bench;
    VirtualAxes unlinked(bench.job.program->start);
    EXPECT_THROW(unlinked.start(bench.work), Error);
    bench.axes.start(bench.work);
    EXPECT_THROW(bench.axes.start(bench.work), Error);
}

/// Commands in any order at any time: the axes move only while running, or braking from it.
TEST(VirtualAxes, MoveOnlyWhenTheyMayWhateverTheyAreTold) {
    std::mt19937 random(42);
    std::uniform_int_distribution<int> what(0, 9);
    std::uniform_real_distribution<double> pause(0.0, 0.4);
    for (int run = 0; run < 100; ++run) {
        VirtualAxesBench bench;
        for (int k = 0; k < 60; ++k) {
            switch (what(random)) {
            case 0:
            case 1:
                if (bench.axes.status().state == DriverState::idle && k == 0) {
                    bench.axes.start(bench.work);
                }
                break;
            case 2:
            case 3:
                bench.axes.hold();
                break;
            case 4:
            case 5:
                bench.axes.resume();
                break;
            case 6:
                if (k > 30) {
                    bench.axes.stop();
                }
                break;
            case 7:
                if (k > 50) {
                    bench.axes.emergency_stop("test");
                }
                break;
            default:
                break;
            }
            const DriverStatus before = bench.axes.status();
            const bool may_move = bench.axes.moving();
            bench.axes.advance(pause(random));
            const DriverStatus after = bench.axes.status();
            if (!may_move) {
                EXPECT_EQ(before.position, after.position);
                EXPECT_EQ(before.velocity.norm(), 0.0);
            } else {
                EXPECT_TRUE(before.state == DriverState::running || before.state == DriverState::holding ||
                            before.state == DriverState::stopping);
            }
            EXPECT_LE(before.executed_blocks, after.executed_blocks);
        }
    }
}

} // namespace
} // namespace millwright::drivers::internal
