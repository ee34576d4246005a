#include "core/motion/trajectory.h"

#include "core/base/error.h"
#include "core/motion/planner.h"
#include "tests/support/motions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::motion {
namespace {

using kinematics::MachineModel;

Trajectory dome_trajectory() {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    return plan(test::post_over("dome", machine, 8, 8).program, machine, {}, {});
}

TEST(Trajectory, IsAtEachBlocksTargetWhenTheBlockEnds) {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    program::ProgramSettings exact;
    exact.path_tolerance = 0.0;
    const program::Program program = test::post_over("dome", machine, 8, 8, exact).program;
    const Trajectory trajectory = plan(program, machine, {}, {});
    for (int n = 0; n < program.block_count(); ++n) {
        const kinematics::AxisPositions off =
            trajectory.at(trajectory.end_of(n)).position - program.blocks.at(std::size_t(n)).target;
        EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-9) << n;
    }
    EXPECT_EQ(trajectory.at(trajectory.duration()).position, program.blocks.back().target);
}

TEST(Trajectory, LastsAsLongAsItsBlocks) {
    const Trajectory trajectory = dome_trajectory();
    double sum = 0.0;
    for (int n = 0; n < trajectory.block_count(); ++n) {
        sum += trajectory.end_of(n) - trajectory.start_of(n);
    }
    EXPECT_NEAR(sum, trajectory.duration(), 1e-9);
}

TEST(Trajectory, IsContinuous) {
    const Trajectory trajectory = dome_trajectory();
    for (int n = 0; n < trajectory.block_count(); ++n) {
        constexpr double instant = 1e-9; // s: 250 mm/s go 2.5e-7 mm in it
        const auto before = trajectory.at(trajectory.end_of(n) - instant).position;
        const auto after = trajectory.at(trajectory.end_of(n) + instant).position;
        EXPECT_LT((after - before).cwiseAbs().maxCoeff(), 1e-6) << n;
    }
}

TEST(Trajectory, StandsAtItsEndsOutsideOfItsTime) {
    const Trajectory trajectory = dome_trajectory();
    EXPECT_EQ(trajectory.at(-5.0).position, trajectory.at(0.0).position);
    EXPECT_EQ(trajectory.at(1e9).position, trajectory.at(trajectory.duration()).position);
    EXPECT_EQ(trajectory.at(1e9).velocity.norm(), 0.0);
    EXPECT_THROW((void)trajectory.at(std::nan("")), Defect);
}

TEST(Trajectory, FindsTheTimeOfABlocksFractionAgain) {
    const Trajectory trajectory = dome_trajectory();
    for (int k = 1; k < 1000; ++k) {
        const double time = trajectory.duration() * k / 1000.0;
        const Sample sample = trajectory.at(time);
        EXPECT_NEAR(trajectory.time_at(sample.block, sample.fraction), time, 1e-7);
    }
}

TEST(Trajectory, FindsTheTimeOfABlocksFractionAgainWithLimitsOfJerk) {
    const MachineModel machine = test::with_jerk(test::machine("ac-table"), 20.0);
    PlannerSettings rounded;
    rounded.path = {program::PathMode::continuous, 0.1};
    const Trajectory trajectory = plan(test::random_program(machine, 100, 3), machine, rounded, {});
    for (int k = 1; k < 1000; ++k) {
        const double time = trajectory.duration() * k / 1000.0;
        const Sample sample = trajectory.at(time);
        const double again = trajectory.time_at(sample.block, sample.fraction);
        // At rest, and nearly so, the way does not tell the time.
        const bool stands = sample.fraction >= 1.0 || sample.velocity.norm() < 1e-3;
        EXPECT_NEAR(again, time, stands ? 0.11 : 1e-7);
        EXPECT_LT((trajectory.at(again).position - sample.position).norm(), 1e-9);
    }
}

TEST(Trajectory, FindsTheTimeOfALengthOnThePartAgain) {
    const Trajectory trajectory = dome_trajectory();
    EXPECT_EQ(trajectory.part_length_at(0.0), 0.0);
    EXPECT_DOUBLE_EQ(trajectory.part_length_at(trajectory.duration()), trajectory.part_length());
    for (int k = 1; k < 1000; ++k) {
        const double length = trajectory.part_length() * k / 1000.0;
        EXPECT_NEAR(trajectory.part_length_at(trajectory.time_at_part_length(length)), length, 1e-6);
    }
    EXPECT_EQ(trajectory.time_at_part_length(1e9), trajectory.duration());
}

TEST(Trajectory, OfAnEmptyProgramTakesNoTime) {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    const Trajectory trajectory = plan(test::empty_program(machine), machine, {}, {});
    EXPECT_EQ(trajectory.duration(), 0.0);
    EXPECT_EQ(trajectory.at(0.0).position.norm(), 0.0);
    EXPECT_EQ(trajectory.part_length_at(1.0), 0.0);
}

TEST(Trajectory, RefusesABlockThatItDoesNotExecute) {
    const Trajectory trajectory = dome_trajectory();
    EXPECT_THROW((void)trajectory.start_of(trajectory.block_count()), Defect);
    EXPECT_THROW((void)trajectory.limit_of(-1), Defect);
}

} // namespace
} // namespace millwright::motion
