// Whatever may be done under a tolerance may be done under a larger one, and coming to rest always may.
#include "core/motion/internal/rounding_choice.h"

#include "core/motion/planner.h"
#include "core/motion/time_estimate.h"
#include "tests/support/machines.h"
#include "tests/support/motions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace millwright::motion {
namespace {

using kinematics::MachineModel;
using program::PathMode;
using program::Program;

double seconds_of(const Program& program, const MachineModel& machine, const PlannerSettings& settings) {
    return plan(program, machine, settings, {}).duration();
}

PlannerSettings rounding_within(double tolerance) {
    PlannerSettings settings;
    settings.path = {PathMode::continuous, tolerance};
    return settings;
}

PlannerSettings stopping() {
    PlannerSettings settings;
    settings.path = {PathMode::exact_stop, 0.0};
    return settings;
}

constexpr std::array tolerances{
    1e-5, 1e-4, 3e-4, 1e-3, 2.54e-3, 5e-3, 0.0254, 0.05, 0.07, 0.3, 1.0, 3.0, 20.0};

void expect_never_slower(const Program& program, const MachineModel& machine, const std::string& what) {
    constexpr double rounding = 1.0 + 1e-9;
    double before = seconds_of(program, machine, stopping());
    for (const double tolerance : tolerances) {
        const double now = seconds_of(program, machine, rounding_within(tolerance));
        EXPECT_LE(now, before * rounding) << what << ", tolerance " << tolerance;
        before = now;
    }
}

std::vector<std::string> shipped_machines() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("assets/machines")) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    return names;
}

TEST(RoundingChoice, ALargerToleranceIsNeverSlowerAndNoneIsSlowerThanStopping) {
    int count = 0;
    for (const std::string& name : shipped_machines()) {
        for (unsigned seed = 1; seed <= 6; ++seed, ++count) {
            MachineModel machine = test::machine(name);
            machine = seed % 3 == 0 ? test::with_jerk(machine, seed % 2 == 0 ? 5.0 : 40.0) : machine;
            expect_never_slower(
                test::random_program(machine, 150, seed), machine, fmt::format("{}, seed {}", name, seed));
        }
    }
    EXPECT_GE(count, 50);
}

/// G1 to these X and Y in turn, the first one by rapid; feeds in mm/min.
struct Turn {
    double x, y, feed;
};

Program program_of(const MachineModel& machine, const std::vector<Turn>& turns) {
    Program program = test::empty_program(machine);
    kinematics::AxisPositions q = program.start;
    for (const Turn& turn : turns) {
        const kinematics::AxisPositions before = q;
        q[machine.axis_index('X')] = turn.x;
        q[machine.axis_index('Y')] = turn.y;
        const double way = (q - before).norm();
        test::add_move(program, q, turn.feed > 0.0 ? way / turn.feed * 60.0 : 0.0);
    }
    return program;
}

// G61.1 took 8.99 s, P1 11.82 and P5 16.44: half of the fast moves went at the feed of the slow ones.
TEST(RoundingChoice, TheFeedOfASlowMoveDoesNotRuleTheFastOneBesideIt) {
    const MachineModel machine = test::machine("router-xyz");
    const Program program = program_of(
        machine, {{0, 0, 0}, {20, 0, 6000}, {20, 20, 300}, {0, 20, 6000}, {0, 40, 300}, {20, 40, 6000}});
    expect_never_slower(program, machine, "feeds that change");
    const double stopped = seconds_of(program, machine, stopping());
    EXPECT_LT(seconds_of(program, machine, rounding_within(1.0)), stopped);
    // Both slow moves take 4 s each at their feed, which nothing shortens by more than their roundings.
    EXPECT_GT(seconds_of(program, machine, rounding_within(1.0)), 2.0 * 18.0 / 5.0);
}

// 19.2 s at rest in every corner, 22.7 within 0.05 mm.
TEST(RoundingChoice, AZigzagIsNotSlowerThanWithStops) {
    const MachineModel machine = test::machine("router-xyz");
    std::vector<Turn> turns{{0, 0, 0}};
    for (int n = 1; n <= 200; ++n) {
        turns.push_back({0.5 * n, n % 2 == 0 ? 0.0 : 0.5, 3000});
    }
    expect_never_slower(program_of(machine, turns), machine, "a zigzag");
}

/// Only sharp corners, between moves of 0.01 to 30 mm with feeds of 60 to 6000 mm/min.
Program sharp_program(const MachineModel& machine, int moves, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> length(-2.0, 1.5), feed(1.8, 3.8);
    std::bernoulli_distribution back(0.3);
    std::vector<Turn> turns{{0, 0, 0}};
    double x = 0.0, y = 0.0, to = 1.0;
    for (int n = 0; n < moves; ++n) {
        to = back(random) ? -to : to;
        (n % 2 == 0 ? x : y) += to * std::pow(10.0, length(random));
        turns.push_back({x, y, std::pow(10.0, feed(random))});
    }
    return program_of(machine, turns);
}

// On an exact path a corner is passed at a speed at which no axis steps by more than it can reach in the
// corner time: braking from that speed and reaching it again takes twice the corner time at most.
TEST(RoundingChoice, AnExactPathIsFasterByNoMoreThanTheCornerTimeInEachSharpCorner) {
    constexpr int moves = 200;
    for (const char* name : {"router-xyz", "forming-table", "rotary-tilt-gui", "rotary-tilt-listing"}) {
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const MachineModel machine = test::machine(name);
            const Program program = sharp_program(machine, moves, seed);
            const std::string what = fmt::format("{}, seed {}", name, seed);
            expect_never_slower(program, machine, what);
            const double exact_path = seconds_of(program, machine, {}); // G61
            const double stopped = seconds_of(program, machine, stopping());
            EXPECT_LT(exact_path, stopped) << what;
            EXPECT_LE(stopped, exact_path + moves * 2.0 * PlannerSettings().corner_time) << what;
        }
    }
}

// It gained nothing on machines without a limit of jerk, whatever the tolerance, and G61 was faster: a
// quarter of the acceleration was left for the motion along roundings that fill the whole way.
TEST(RoundingChoice, AZigzagGainsFromALargeToleranceOnMachinesWithoutJerkLimits) {
    for (const char* name : {"router-xyz", "forming-table"}) {
        const MachineModel machine = test::machine(name);
        std::vector<Turn> turns{{0, 0, 0}};
        for (int n = 1; n <= 200; ++n) {
            turns.push_back({0.5 * n, n % 2 == 0 ? 0.0 : 0.5, 3000});
        }
        const Program program = program_of(machine, turns);
        const double large = seconds_of(program, machine, rounding_within(5.0));
        EXPECT_LT(large, 0.95 * seconds_of(program, machine, stopping())) << name;
        EXPECT_LT(large, seconds_of(program, machine, {})) << name; // G61
    }
}

TEST(RoundingChoice, AnEstimateChoosesAsThePlanDoes) {
    for (const char* name : {"router-xyz", "ac-table"}) {
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const MachineModel machine = test::machine(name);
            Program program = test::random_program(machine, 400, seed);
            for (std::size_t n = 0; n < program.blocks.size(); ++n) { // tolerances that change along the way
                program::Block& block = program.blocks[n];
                constexpr std::array of_blocks{0.002, 0.05, 0.5};
                if (block.moves() && n % 50 != 0) {
                    block.path = program::PathControl{PathMode::continuous, of_blocks[n / 40 % 3]};
                }
            }
            FilterTime filter(machine, program.start);
            for (const program::Block& block : program.blocks) {
                filter.add(block);
            }
            TimeEstimate estimate(machine, {}, program.start, filter);
            for (const program::Block& block : program.blocks) {
                estimate.add(block);
            }
            const double whole = seconds_of(program, machine, {});
            EXPECT_NEAR(estimate.finish(), whole, 1e-9 * whole) << name << ", seed " << seed;
        }
    }
}

TEST(RoundingSteps, AreTheSameForAllTolerances) {
    using internal::next_rounding_step;
    using internal::rounding_step;
    EXPECT_EQ(rounding_step(0.9e-4), 0.0);
    EXPECT_EQ(rounding_step(1e-4), 1e-4);
    EXPECT_EQ(rounding_step(0.005), 0.005);
    EXPECT_EQ(rounding_step(0.0254), 0.02);
    EXPECT_EQ(rounding_step(0.1 + 0.2 - 0.1), 0.2);
    EXPECT_EQ(next_rounding_step(0.0), 1e-4);
    EXPECT_EQ(next_rounding_step(0.5), 1.0);
    EXPECT_EQ(next_rounding_step(1e4), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace millwright::motion
