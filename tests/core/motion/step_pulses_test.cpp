#include "core/motion/step_pulses.h"

#include "core/base/error.h"
#include "core/motion/hold.h"
#include "core/motion/planner.h"
#include "tests/core/motion/listing_machine.h"
#include "tests/support/motions.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace millwright::motion {
namespace {

using kinematics::AxisPositions;
using test::at_xy;
using test::listing_machine;

/// Feeds through `targets`, 1 s each.
Trajectory planned_feeds(const std::vector<AxisPositions>& targets) {
    program::Program program = test::empty_program(listing_machine());
    for (const AxisPositions& target : targets) {
        test::add_move(program, target, 1.0);
    }
    return plan(program, listing_machine(), {}, {});
}

StepSettings hundred_per_mm() {
    StepSettings settings;
    settings.steps_per_unit.assign(5, 100.0);
    return settings;
}

struct Pulsed {
    std::vector<StepPulse> pulses;
    std::vector<StepJitter> axes;
};

Pulsed pulsed(const Trajectory& trajectory, const StepSettings& settings) {
    Pulsed found;
    const StepSink collect = [&](std::span<const StepPulse> block) {
        found.pulses.insert(found.pulses.end(), block.begin(), block.end());
    };
    found.axes = step_pulses(trajectory, settings, collect, {});
    return found;
}

TEST(StepPulses, AreAsManyAsTheWayHasSteps) {
    const Pulsed found = pulsed(planned_feeds({at_xy(10.0, -5.0), at_xy(4.0, -5.0)}), hundred_per_mm());
    EXPECT_EQ(found.axes[0].pulses, 1600);
    EXPECT_EQ(found.axes[0].reversals, 1);
    EXPECT_EQ(found.axes[1].pulses, 500);
    EXPECT_EQ(found.axes[2].pulses, 0);
    EXPECT_EQ(found.pulses.size(), 2100U);
    EXPECT_EQ(found.pulses.back().position, 400);
    EXPECT_EQ(found.pulses.back().direction, -1);
}

/// Every pulse is due where the plan is in the middle between two steps.
void expect_half_a_step(const Trajectory& trajectory) {
    StepSettings settings = hundred_per_mm();
    settings.steps_per_unit = {400.0, 400.0, 400.0, 3000.0, 3000.0};
    const Pulsed found = pulsed(trajectory, settings);
    ASSERT_GT(found.pulses.size(), 1000U);
    for (const StepPulse& pulse : found.pulses) {
        const double planned = trajectory.at(pulse.due).position[pulse.axis] *
                               settings.steps_per_unit[static_cast<std::size_t>(pulse.axis)];
        ASSERT_NEAR(planned, static_cast<double>(pulse.position) - 0.5 * pulse.direction, 1e-5);
    }
    for (const StepJitter& axis : found.axes) {
        EXPECT_LE(std::abs(axis.end_error_steps), 0.5 + 1e-9);
    }
}

TEST(StepPulses, KeepTheMotorWithinHalfAStepOfThePlanAtEveryMoment) {
    const auto model = listing_machine();
    expect_half_a_step(plan(test::random_program(model, 60, 7), model, {}, {}));
}

TEST(StepPulses, FollowRoundedCornersWhereAnAxisTurnsBackWithinABlock) {
    const auto model = test::with_jerk(listing_machine(), 20.0);
    PlannerSettings rounded;
    rounded.path = {program::PathMode::continuous, 5.0};
    rounded.rounding_angle = 0.1;
    const Trajectory whole = plan(test::random_program(model, 60, 7), model, rounded, {});
    expect_half_a_step(whole);
    const Trajectory braking = brake(whole, 0.4 * whole.duration());
    expect_half_a_step(go_on(braking, 0.5 * braking.duration(), {}));
}

TEST(StepPulses, AreInOrderAndApart) {
    StepSettings settings = hundred_per_mm();
    settings.timer_frequency = 20'000.0;
    settings.min_interval = 3;
    const Pulsed found = pulsed(planned_feeds({at_xy(50.0, 20.0), at_xy(0.0, 0.0)}), settings);
    std::vector<std::int64_t> last(5, -3);
    for (const StepPulse& pulse : found.pulses) {
        std::int64_t& before = last[static_cast<std::size_t>(pulse.axis)];
        ASSERT_GE(pulse.tick - before, 3);
        before = pulse.tick;
    }
}

TEST(StepPulses, AreOffByHalfATickAtMostWhereTheTimerIsFastEnough) {
    const Pulsed found = pulsed(planned_feeds({at_xy(10.0)}), hundred_per_mm());
    EXPECT_EQ(found.axes[0].late, 0);
    EXPECT_LE(found.axes[0].max_jitter, 0.5e-6 + 1e-15);
    EXPECT_GT(found.axes[0].rms_jitter, 0.2e-6);
    EXPECT_LT(found.axes[0].rms_jitter, 0.35e-6) << "evenly spread over a tick: 1/sqrt(12) of it";
}

TEST(StepPulses, SayHowFastTheyCome) {
    const Pulsed found = pulsed(planned_feeds({at_xy(10.0)}), hundred_per_mm()); // 10 mm/s
    EXPECT_NEAR(found.axes[0].max_frequency, 1000.0, 1e-3);
    StepSettings slow = hundred_per_mm();
    slow.timer_frequency = 2500.0; // a pulse in 2 or in 3 ticks
    slow.min_interval = 1;
    EXPECT_NEAR(pulsed(planned_feeds({at_xy(10.0)}), slow).axes[0].given_frequency, 1250.0, 1e-9);
}

TEST(StepPulses, ComeLateFromATimerThatIsTooSlow) {
    StepSettings settings = hundred_per_mm();
    settings.timer_frequency = 1000.0; // 1000 pulses per second need one every tick
    settings.min_interval = 2;
    settings.jitter_limit = 1e-3;
    const Pulsed found = pulsed(planned_feeds({at_xy(10.0)}), settings);
    EXPECT_GT(found.axes[0].late, 900);
    EXPECT_GT(found.axes[0].over_limit, 900);
    EXPECT_NEAR(found.axes[0].max_jitter, 1.0, 0.05);
    EXPECT_EQ(found.axes[0].overrun_block, 0);
    EXPECT_NEAR(found.axes[0].given_frequency, 500.0, 1e-9);
    EXPECT_EQ(found.axes[1].overrun_block, -1);
}

TEST(StepPulses, TellTheBlockFromWhichTheTimerDoesNotKeepUp) {
    StepSettings settings = hundred_per_mm();
    settings.timer_frequency = 1000.0;
    EXPECT_EQ(pulsed(planned_feeds({at_xy(3.0), at_xy(6.0), at_xy(16.0)}), settings).axes[0].overrun_block,
              2);
    EXPECT_EQ(pulsed(planned_feeds({at_xy(3.0), at_xy(0.0), at_xy(3.0)}), settings).axes[0].overrun_block, -1)
        << "back over the same step at once is one pulse that waits";
}

TEST(StepPulses, StartOnTheStepNearestToTheMotion) {
    program::Program program = test::empty_program(listing_machine());
    test::add_move(program, at_xy(0.019), 1.0);
    const Trajectory trajectory = plan(program, listing_machine(), {}, {}, at_xy(0.004));
    const Pulsed found = pulsed(trajectory, hundred_per_mm());
    ASSERT_EQ(found.pulses.size(), 2U); // over 0.005 and 0.015
    EXPECT_EQ(found.pulses[1].position, 2);
    EXPECT_NEAR(found.axes[0].end_error_steps, -0.1, 1e-9);
}

TEST(StepPulses, OfAHoldEndWhereItComesToRestAndGoOnFromThere) {
    const Trajectory whole = planned_feeds({at_xy(10.0), at_xy(20.0, 10.0)});
    const StepSettings settings = hundred_per_mm();
    const Trajectory braking = brake(whole, 0.7 * whole.duration());
    const Trajectory rest = go_on(braking, braking.duration(), {});
    const std::int64_t steps =
        pulsed(braking, settings).axes[0].pulses + pulsed(rest, settings).axes[0].pulses;
    EXPECT_NEAR(static_cast<double>(steps), 100.0 * (20.0 - braking.at(0.0).position[0]), 2.0);
    EXPECT_LE(std::abs(pulsed(braking, settings).axes[0].end_error_steps), 0.5 + 1e-9);
    EXPECT_LE(std::abs(pulsed(rest, settings).axes[1].end_error_steps), 0.5 + 1e-9);
}

TEST(StepPulses, OfALongBlockComeInOrderAndInSmallParts) {
    StepSettings settings = hundred_per_mm();
    settings.steps_per_unit = {1e4, 7e3, 100.0, 100.0, 100.0};
    std::size_t most = 0;
    std::int64_t count = 0;
    std::int64_t last = 0;
    bool ascends = true;
    const StepSink look = [&](std::span<const StepPulse> part) {
        most = std::max(most, part.size());
        for (const StepPulse& pulse : part) {
            ascends = ascends && pulse.tick >= last;
            last = pulse.tick;
            ++count;
        }
    };
    (void)step_pulses(planned_feeds({at_xy(8.0, -6.0)}), settings, look, {});
    EXPECT_EQ(count, 80'000 + 42'000);
    EXPECT_TRUE(ascends);
    EXPECT_LE(most, 4096U);
}

TEST(StepPulses, RefuseSettingsWithoutSense) {
    const test::WithoutTraps numbers_that_are_none;
    const Trajectory trajectory = planned_feeds({at_xy(1.0)});
    const auto refused = [&](auto change) {
        StepSettings settings = hundred_per_mm();
        change(settings);
        EXPECT_THROW((void)pulsed(trajectory, settings), Error);
    };
    refused([](StepSettings& s) { s.steps_per_unit.pop_back(); });
    refused([](StepSettings& s) { s.steps_per_unit[1] = 0.0; });
    refused([](StepSettings& s) { s.steps_per_unit[1] = std::nan(""); });
    refused([](StepSettings& s) { s.timer_frequency = 0.0; });
    refused([](StepSettings& s) { s.min_interval = 0; });
    refused([](StepSettings& s) { s.most_pulses_per_block = 99; });
}

} // namespace
} // namespace millwright::motion
