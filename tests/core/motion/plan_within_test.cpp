#include "core/base/error.h"
#include "core/motion/planner.h"
#include "tests/core/motion/listing_machine.h"
#include "tests/support/motions.h"
#include "tests/support/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::motion {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using program::Program;
using test::at_xy;
using test::listing_machine;

Program feed_program(const std::vector<AxisPositions>& targets, double duration) {
    Program program = test::empty_program(listing_machine());
    for (const AxisPositions& target : targets) {
        test::add_move(program, target, duration);
    }
    return program;
}

Trajectory within(const Program& program, double acceleration, const PlannerSettings& settings = {}) {
    const std::vector<double> all(program.blocks.size(), acceleration);
    return plan_within(program, all, listing_machine(), settings, {});
}

/// Of X, Y and Z together, at even times.
double greatest_acceleration(const Trajectory& trajectory) {
    constexpr int samples = 20'000;
    double greatest = 0.0;
    for (int n = 0; n <= samples; ++n) {
        const Sample sample = trajectory.at(trajectory.duration() * n / samples);
        greatest = std::max(greatest, sample.acceleration.head<3>().norm());
    }
    return greatest;
}

constexpr double rounding_s = 1e-12;

TEST(PlanWithin, KeepsToTheAccelerationOfTheProgramAlongADiagonal) {
    const double way = std::hypot(60.0, 80.0);
    const Trajectory trajectory = within(feed_program({at_xy(60.0, 80.0)}, 10.0), 40.0); // at 10 mm/s
    EXPECT_NEAR(trajectory.duration(), way / 10.0 + 10.0 / 40.0, rounding_s);
    EXPECT_NEAR(greatest_acceleration(trajectory), 40.0, 1e-9);
}

TEST(PlanWithin, IsThePlanWhereTheProgramAllowsMoreThanTheAxesHave) {
    const Program program = feed_program({at_xy(100.0), at_xy(100.0, 20.0)}, 1.0);
    const double duration = plan(program, listing_machine(), {}, {}).duration();
    EXPECT_EQ(within(program, 1e6).duration(), duration);
    EXPECT_EQ(within(program, std::numeric_limits<double>::infinity()).duration(), duration);
}

TEST(PlanWithin, TakesTheAccelerationOfEachBlockForItself) {
    const Program program = feed_program({at_xy(50.0), at_xy(100.0)}, 5.0); // straight on at 10 mm/s
    const Trajectory trajectory = plan_within(program, std::vector{50.0, 20.0}, listing_machine(), {}, {});
    EXPECT_NEAR(trajectory.duration(), 10.0 + 0.5 * 10.0 / 50.0 + 0.5 * 10.0 / 20.0, rounding_s);
}

TEST(PlanWithin, StepsInACornerByWhatThatAccelerationReaches) {
    const Trajectory trajectory =
        within(feed_program({at_xy(60.0), at_xy(60.0, 60.0)}, 6.0), 40.0); // a right angle
    const double corner = trajectory.time_at(1, 0.0);
    constexpr double little = 1e-9; // s
    const AxisPositions step =
        trajectory.at(corner + little).velocity - trajectory.at(corner - little).velocity;
    EXPECT_NEAR(step.norm(), 40.0 * PlannerSettings{}.corner_time, 1e-6);
}

TEST(PlanWithin, KeepsToThatAccelerationOnRoundings) {
    PlannerSettings settings;
    settings.path = {program::PathMode::continuous, 0.5};
    const Program program = feed_program({at_xy(60.0), at_xy(60.0, 60.0), at_xy(20.0, 90.0)}, 1.0);
    const double greatest = greatest_acceleration(within(program, 40.0, settings));
    EXPECT_LE(greatest, 40.0 + 1e-9);
    EXPECT_GE(greatest, 39.0);
}

TEST(PlanWithin, WantsAPositiveAccelerationForEachBlock) {
    const Program program = feed_program({at_xy(60.0)}, 1.0);
    EXPECT_THROW((void)plan_within(program, {}, listing_machine(), {}, {}), Defect);
    EXPECT_THROW((void)within(program, 0.0), Defect);
}

} // namespace
} // namespace millwright::motion
