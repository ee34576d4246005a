#include "core/motion/time_estimate.h"

#include "core/base/error.h"
#include "tests/support/motions.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace millwright::motion {
namespace {

using kinematics::MachineModel;
using program::BlockKind;
using program::PathMode;
using program::Program;

struct Estimated {
    double seconds = 0.0;
    int most_kept = 0; ///< blocks
};

FilterTime filter_of(const Program& program, const MachineModel& machine) {
    FilterTime filter(machine, program.start);
    for (const program::Block& block : program.blocks) {
        filter.add(block);
    }
    return filter;
}

Estimated
estimated(const Program& program, const MachineModel& machine, const PlannerSettings& settings = {}) {
    TimeEstimate estimate(machine, settings, program.start, filter_of(program, machine));
    Estimated result;
    for (const program::Block& block : program.blocks) {
        estimate.add(block);
        result.most_kept = std::max(result.most_kept, estimate.blocks_kept());
    }
    result.seconds = estimate.finish();
    return result;
}

/// A way that winds for ever and never rests: blocks of 0.05 to 0.5 mm, feeds that change all the while.
Program winding(const MachineModel& machine, int blocks, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Program program = test::empty_program(machine);
    kinematics::AxisPositions q = program.start;
    double heading = 0.0;
    double speed = 50.0;
    for (int n = 0; n < blocks; ++n) {
        heading += 0.2 * (share(random) - 0.5);
        speed = std::clamp(speed * (0.9 + 0.2 * share(random)), 1.0, 400.0);
        const double length = 0.05 + 0.45 * share(random);
        q[machine.axis_index('X')] += length * std::cos(heading);
        q[machine.axis_index('Y')] += length * std::sin(heading);
        for (const char letter : {'A', 'C'}) {
            if (machine.axis_index(letter) >= 0) {
                q[machine.axis_index(letter)] += 0.002 * (share(random) - 0.5);
            }
        }
        test::add_move(program, q, share(random) < 0.02 ? 0.0 : length / speed);
    }
    return program;
}

PlannerSettings settings_for(unsigned seed) {
    PlannerSettings settings;
    settings.path = {seed % 3 == 0   ? PathMode::exact_path
                     : seed % 3 == 1 ? PathMode::continuous
                                     : PathMode::exact_path,
                     0.02};
    settings.corner_rule = seed % 3 == 2 ? CornerRule::junction_deviation : CornerRule::small_step;
    settings.feed_rule = seed % 5 == 0 ? FeedRule::on_part : FeedRule::programmed_time;
    settings.look_ahead = seed % 4 == 3 ? 16 : 0;
    return settings;
}

MachineModel machine_for(unsigned seed) {
    const MachineModel machine = test::machine(seed % 2 == 0 ? "router-xyz" : "ac-table");
    constexpr double none = std::numeric_limits<double>::infinity();
    return test::with_jerk(machine, seed % 7 == 0 ? none : seed % 7 < 4 ? 5.0 : 40.0);
}

void expect_the_whole_plan(const Program& program, unsigned seed, int most_kept) {
    const MachineModel machine = machine_for(seed);
    const PlannerSettings settings = settings_for(seed);
    const double whole = plan(program, machine, settings, {}).duration();
    const Estimated found = estimated(program, machine, settings);
    EXPECT_NEAR(found.seconds, whole, 1e-9 * whole) << "seed " << seed;
    EXPECT_LT(found.most_kept, most_kept) << "seed " << seed;
}

constexpr unsigned every_setting = 8; ///< seeds that meet each rule, look-ahead, jerk and machine

void expect_estimates(unsigned first, unsigned last) {
    for (unsigned seed = first; seed <= last; ++seed) {
        constexpr int blocks = 12'000; // fewer than the estimate may keep
        expect_the_whole_plan(test::random_program(machine_for(seed), blocks, seed), seed, blocks + 1);
    }
}

void expect_estimates_of_winding_paths(unsigned first, unsigned last) {
    for (unsigned seed = first; seed <= last; ++seed) {
        expect_the_whole_plan(winding(machine_for(seed), 30'000, seed), seed, 15'000);
    }
}

TEST(TimeEstimate, IsTheDurationOfTheWholePlan) {
    expect_estimates(1, every_setting);
}

TEST(TimeEstimate, IsTheDurationOfAPlanThatNeverRests) {
    expect_estimates_of_winding_paths(1, every_setting);
}

TEST(TimeEstimateInFull, IsTheDurationOfTheWholePlan) {
    expect_estimates(every_setting + 1, 3 * every_setting);
    expect_estimates_of_winding_paths(every_setting + 1, 3 * every_setting);
}

/// Braking from the feed takes more blocks than the window has.
TEST(TimeEstimate, LooksAsFarAheadAsItHasTo) {
    const MachineModel shipped = test::machine("router-xyz");
    kinematics::MachineDescription description = shipped.description();
    for (auto* axes : {&description.table, &description.head}) {
        for (kinematics::MachineAxis& axis : *axes) {
            axis.max_acceleration = 20.0;
        }
    }
    const MachineModel sluggish(std::move(description));
    Program program = test::empty_program(sluggish);
    kinematics::AxisPositions q = program.start;
    for (int n = 0; n < 60'000; ++n) {
        q[0] += 0.01;
        test::add_move(program, q, 0.01 / (n % 20'000 < 10'000 ? 60.0 : 5.0));
    }
    const double whole = plan(program, sluggish, {}, {}).duration();
    EXPECT_NEAR(estimated(program, sluggish).seconds, whole, 1e-9 * whole);
    PlannerSettings thousand;
    thousand.look_ahead = 1000;
    EXPECT_GT(plan(program, sluggish, thousand, {}).duration(), 1.01 * whole); // so it matters
}

TEST(TimeEstimate, KeepsLittleOfALongProgram) {
    const MachineModel machine = test::machine("ac-table");
    const Program program = winding(machine, 300'000, 5);
    EXPECT_LT(estimated(program, machine).most_kept, 10'000);
}

TEST(TimeEstimate, CountsWhatStands) {
    const MachineModel machine = test::machine("router-xyz");
    Program program = test::empty_program(machine);
    EXPECT_EQ(estimated(program, machine).seconds, 0.0);
    for (int n = 0; n < 9000; ++n) {
        test::add_block(program, BlockKind::dwell);
        program.blocks.back().duration = 0.5;
        test::add_block(program, BlockKind::comment);
    }
    EXPECT_NEAR(estimated(program, machine).seconds, 4500.0, 1e-6);
    EXPECT_NEAR(plan(program, machine, {}, {}).duration(), 4500.0, 1e-6);
}

TEST(TimeEstimate, KnowsTheFilterAsSoonAsTheSlowestAxisHasMoved) {
    const MachineModel machine = test::with_jerk(test::machine("router-xyz"), 10.0);
    Program program = test::empty_program(machine);
    FilterTime filter(machine, program.start);
    EXPECT_FALSE(filter.settled());
    kinematics::AxisPositions q = program.start;
    test::add_move(program, q);
    filter.add(program.blocks.back());
    EXPECT_EQ(filter.seconds(), 0.0);
    q[0] += 1.0;
    test::add_move(program, q);
    filter.add(program.blocks.back());
    EXPECT_TRUE(filter.settled());
    EXPECT_NEAR(filter.seconds(), 0.2, 1e-12);
    constexpr double none = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(FilterTime(test::with_jerk(machine, none), program.start).settled());
}

TEST(TimeEstimate, RefusesWhatThePlannerRefuses) {
    const MachineModel machine = test::machine("router-xyz");
    Program program = winding(machine, 5, 1);
    PlannerSettings settings;
    settings.look_ahead = -1;
    EXPECT_THROW((void)estimated(program, machine, settings), Defect);
    const test::WithoutTraps traps;
    program.blocks.back().target[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)estimated(program, machine), Defect);
}

} // namespace
} // namespace millwright::motion
