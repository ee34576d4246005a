#include "core/drivers/virtual_machine/virtual_machine.h"

#include "core/base/error.h"
#include "tests/support/jobs.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

namespace millwright::drivers {
namespace {

using kinematics::AxisPositions;

struct VirtualMachineBench {
    jobs::Job job = test::dome_job();
    Work work = test::work_of(job);
    test::ManualClock clock;
    VirtualMachine machine;

    explicit VirtualMachineBench(double speed = 1.0) : machine(job.program->start, {speed}, clock) {
        machine.connect();
    }
};

TEST(VirtualMachine, IsDisconnectedUntilConnectedAndAfterClosing) {
    const jobs::Job job = test::dome_job();
    test::ManualClock clock;
    VirtualMachine machine(job.program->start, {}, clock);
    EXPECT_EQ(machine.status().state, DriverState::disconnected);
    machine.connect();
    EXPECT_EQ(machine.status().state, DriverState::idle);
    EXPECT_EQ(machine.status().position, job.program->start);
    machine.close();
    EXPECT_EQ(machine.status().state, DriverState::disconnected);
}

TEST(VirtualMachine, MovesByItsClockTimesItsSpeed) {
    VirtualMachineBench bench(4.0);
    bench.machine.start(bench.work);
    bench.clock.wait(0.5);
    EXPECT_NEAR(bench.machine.status().planned_time, 2.0, 1e-6);
    bench.machine.set_speed({0.5});
    bench.clock.wait(1.0);
    const DriverStatus status = bench.machine.status();
    EXPECT_NEAR(status.planned_time, 2.5, 1e-6);
    const AxisPositions planned = bench.work.trajectory->at(status.planned_time).position;
    EXPECT_LT((status.position - planned).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(VirtualMachine, DoesNotMoveWhileItsClockStands) {
    VirtualMachineBench bench;
    bench.machine.start(bench.work);
    bench.clock.wait(2.0);
    const AxisPositions there = bench.machine.status().position;
    std::this_thread::yield();
    EXPECT_EQ(bench.machine.status().position, there);
}

TEST(VirtualMachine, HoldsResumesAndComesToTheEnd) {
    VirtualMachineBench bench;
    bench.machine.start(bench.work);
    bench.clock.wait(3.0);
    bench.machine.hold();
    bench.clock.wait(1.0);
    EXPECT_EQ(bench.machine.status().state, DriverState::holding);
    EXPECT_EQ(bench.machine.status().velocity.norm(), 0.0);
    bench.machine.resume();
    bench.clock.wait(1e5);
    EXPECT_EQ(bench.machine.status().state, DriverState::idle);
    EXPECT_EQ(bench.machine.status().position, bench.job.program->blocks.back().target);
}

TEST(VirtualMachine, StopsOnThePathWhenClosedAndStaysThere) {
    VirtualMachineBench bench;
    bench.machine.start(bench.work);
    bench.clock.wait(3.0);
    bench.machine.close();
    bench.machine.connect();
    const DriverStatus status = bench.machine.status();
    EXPECT_EQ(status.state, DriverState::idle);
    bench.clock.wait(10.0);
    EXPECT_EQ(bench.machine.status().position, status.position);
    EXPECT_NE(status.position, bench.job.program->start);
}

TEST(VirtualMachine, RunsToTheEndByItselfWithUnlimitedSpeed) {
    VirtualMachineBench bench(VirtualSpeed::unlimited);
    bench.machine.start(bench.work);
    while (bench.machine.status().state == DriverState::running) {
        std::this_thread::yield();
    }
    EXPECT_EQ(bench.machine.status().state, DriverState::idle);
    EXPECT_EQ(bench.machine.status().executed_blocks, bench.job.program->block_count());
}

TEST(VirtualMachine, CanBeDestroyedAtAnyMoment) {
    for (const double speed : {1.0, VirtualSpeed::unlimited}) {
        for (int moment = 0; moment < 10; ++moment) {
            VirtualMachineBench bench(speed);
            bench.machine.start(bench.work);
            bench.clock.wait(moment);
            if (moment % 2 == 0) {
                bench.machine.hold();
            }
        }
    }
}

TEST(VirtualMachine, TakesCommandsFromManyThreads) {
    VirtualMachineBench bench(VirtualSpeed::unlimited);
    bench.machine.start(bench.work);
    std::vector<std::jthread> people;
    std::atomic<int> looks = 0;
    for (int person = 0; person < 4; ++person) {
        people.emplace_back([&bench, &looks, person] {
            for (int k = 0; k < 100; ++k) {
                if (person == 0) {
                    bench.machine.hold();
                } else if (person == 1) {
                    bench.machine.resume();
                } else if (person == 2) {
                    bench.machine.set_speed({k % 2 == 0 ? VirtualSpeed::unlimited : 100.0});
                } else {
                    bench.clock.wait(0.01);
                }
                looks += bench.machine.status().position.allFinite() ? 1 : 0;
            }
        });
    }
    people.clear();
    EXPECT_EQ(looks, 400);
    bench.machine.set_speed({VirtualSpeed::unlimited});
    bench.machine.resume();
    while (bench.machine.status().state == DriverState::running) {
        std::this_thread::yield();
    }
    EXPECT_EQ(bench.machine.status().executed_blocks, bench.job.program->block_count());
}

TEST(VirtualMachine, RefusesASpeedOutOfRange) {
    const test::WithoutTraps numbers_that_are_none;
    VirtualMachineBench bench;
    for (const double speed : {-1.0, 0.001, 1001.0, std::nan("")}) {
        EXPECT_THROW(bench.machine.set_speed({speed}), Error);
        EXPECT_THROW(VirtualMachine(bench.job.program->start, {speed}, bench.clock), Error);
    }
}

} // namespace
} // namespace millwright::drivers
