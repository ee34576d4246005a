#include "core/motion/planner.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/motion/hold.h"
#include "tests/core/motion/listing_machine.h"
#include "tests/support/motions.h"
#include "tests/support/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace millwright::motion {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using program::BlockKind;
using program::Program;
using test::listing_machine;

AxisPositions at_xyz(double x, double y = 0.0, double z = 0.0) {
    AxisPositions q = AxisPositions::Zero(5);
    q.head<3>() << x, y, z;
    return q;
}

Program moves(const std::vector<AxisPositions>& targets, double duration = 0.0) {
    Program program = test::empty_program(listing_machine());
    for (const AxisPositions& target : targets) {
        test::add_move(program, target, duration);
    }
    return program;
}

Trajectory planned_path(const Program& program, const PlannerSettings& settings = {}) {
    return plan(program, listing_machine(), settings, {});
}

constexpr double planner_rounding_s = 1e-12;

TEST(Planner, DrivesALongRapidAsATrapezoid) {
    EXPECT_NEAR(
        planned_path(moves({at_xyz(100.0)})).duration(), 100.0 / 250.0 + 250.0 / 1500.0, planner_rounding_s);
}

TEST(Planner, DrivesAShortRapidAsATriangle) {
    EXPECT_NEAR(
        planned_path(moves({at_xyz(10.0)})).duration(), 2.0 * std::sqrt(10.0 / 1500.0), planner_rounding_s);
}

TEST(Planner, TakesAFeedAsTheTopSpeedAndAddsTheRamps) {
    EXPECT_NEAR(planned_path(moves({at_xyz(50.0)}, 5.0)).duration(), 5.0 + 10.0 / 1500.0, planner_rounding_s);
}

TEST(Planner, KeepsToTheSlowestAxisOfADiagonal) {
    // Z is the slower one in both: 200 and 1200.
    const Trajectory trajectory = planned_path(moves({at_xyz(100.0, 0.0, 100.0)}));
    EXPECT_NEAR(trajectory.duration(), 100.0 / 200.0 + 200.0 / 1200.0, planner_rounding_s);
    EXPECT_EQ(trajectory.limit_of(0).limit, Limit::axis_velocity);
    EXPECT_EQ(trajectory.limit_of(0).axis, 2);
}

TEST(Planner, SaysWhatKeepsABlockFromBeingFaster) {
    Program program = moves({at_xyz(1.0)});
    test::add_move(program, at_xyz(101.0), 5.0);
    test::add_block(program, BlockKind::dwell);
    const Trajectory trajectory = planned_path(program);
    EXPECT_EQ(trajectory.limit_of(0).limit, Limit::axis_acceleration);
    EXPECT_EQ(trajectory.limit_of(0).axis, 0);
    EXPECT_EQ(trajectory.limit_of(1).limit, Limit::programmed_feed);
    EXPECT_EQ(trajectory.limit_of(1).axis, -1);
    EXPECT_EQ(trajectory.limit_of(2).limit, Limit::standing);
}

TEST(Planner, DoesNotNoticeThatAStraightWayIsCutIntoBlocks) {
    std::vector<AxisPositions> steps;
    for (int n = 1; n <= 200; ++n) {
        steps.push_back(at_xyz(0.5 * n, 0.25 * n, -0.125 * n));
    }
    EXPECT_NEAR(planned_path(moves(steps)).duration(), planned_path(moves({steps.back()})).duration(), 1e-9);
}

TEST(Planner, TurnsACornerWithTheAllowedStepAndNoMore) {
    PlannerSettings settings;
    settings.corner_time = 0.004;
    const Trajectory trajectory = planned_path(moves({at_xyz(50.0), at_xyz(50.0, 50.0)}), settings);
    const double corner = trajectory.end_of(0);
    const Sample before = trajectory.at(corner - 1e-9);
    const Sample after = trajectory.at(corner + 1e-9);
    EXPECT_NEAR(before.velocity[0], 1500.0 * 0.004, 1e-5);
    EXPECT_NEAR(after.velocity[1], 1500.0 * 0.004, 1e-5);
    EXPECT_NEAR(after.velocity[0], 0.0, 1e-12);
}

TEST(Planner, StopsInEveryCornerIfAskedTo) {
    PlannerSettings exact;
    exact.path.mode = program::PathMode::exact_stop;
    const double one = planned_path(moves({at_xyz(50.0)})).duration();
    EXPECT_NEAR(planned_path(moves({at_xyz(50.0), at_xyz(100.0), at_xyz(100.0, 50.0)}), exact).duration(),
                3.0 * one,
                planner_rounding_s);
}

TEST(Planner, ObeysThePathModeOfEachBlock) {
    const double one = planned_path(moves({at_xyz(50.0)})).duration();
    const double through = planned_path(moves({at_xyz(100.0)})).duration();
    Program program = moves({at_xyz(50.0), at_xyz(100.0), at_xyz(150.0)});
    program.blocks[0].path = program::PathControl{program::PathMode::exact_stop, 0.0};
    EXPECT_NEAR(planned_path(program).duration(), one + through, planner_rounding_s);
}

TEST(Planner, RoundsACornerWithoutAnyStepOfVelocity) {
    Program program = moves({at_xyz(50.0), at_xyz(50.0, 50.0)}, 1.0);
    const double exact = planned_path(program).duration();
    program.blocks[0].path = program::PathControl{program::PathMode::continuous, 0.1};
    const Trajectory rounded = planned_path(program);
    EXPECT_LT(rounded.duration(), exact);
    const double corner = rounded.end_of(0);
    EXPECT_EQ(rounded.limit_at(corner).limit, Limit::corner);
    EXPECT_NEAR(rounded.at(corner).velocity[0], rounded.at(corner).velocity[1], 1e-9);
    EXPECT_LT((rounded.at(corner - 1e-7).velocity - rounded.at(corner + 1e-7).velocity).norm(), 1e-3);
}

TEST(Planner, RestsBetweenRapidAndFeedOfAContinuousPath) {
    Program program = moves({at_xyz(50.0)});
    test::add_move(program, at_xyz(50.0, 50.0), 1.0);
    program.blocks[0].path = program::PathControl{program::PathMode::continuous, 1.0};
    const Trajectory trajectory = planned_path(program);
    EXPECT_EQ(trajectory.at(trajectory.end_of(0)).velocity.norm(), 0.0);
    EXPECT_EQ(trajectory.at(trajectory.end_of(0)).position, at_xyz(50.0));
}

TEST(Planner, PassesACornerByJunctionDeviation) {
    PlannerSettings settings;
    settings.corner_rule = CornerRule::junction_deviation;
    settings.junction_deviation = 0.02;
    const Trajectory trajectory = planned_path(moves({at_xyz(50.0), at_xyz(50.0, 50.0)}), settings);
    // A right angle: sin(45 deg); X and Y can do 1500 each, so 1500 * sqrt(2) in the direction of the change.
    const double sine = std::sqrt(0.5);
    const double speed = std::sqrt(1500.0 * std::sqrt(2.0) * 0.02 * sine / (1.0 - sine));
    EXPECT_NEAR(trajectory.at(trajectory.end_of(0) - 1e-9).velocity[0], speed, 1e-4);
}

/// With a jerk that takes 1 / rate seconds to reach the acceleration.
Trajectory planned_with_jerk(const Program& program, double rate) {
    return plan(program, test::with_jerk(listing_machine(), rate), {}, {});
}

TEST(Planner, NeedsForALimitOfJerkTheTimeOfItsFilterAtEachRest) {
    const Program once = moves({at_xyz(100.0)});
    EXPECT_NEAR(
        planned_with_jerk(once, 20.0).duration(), planned_path(once).duration() + 0.1, planner_rounding_s);
    Program twice = moves({at_xyz(100.0)});
    test::add_block(twice, BlockKind::dwell);
    twice.blocks.back().duration = 1.5;
    test::add_move(twice, at_xyz(200.0));
    const Trajectory trajectory = planned_with_jerk(twice, 20.0);
    EXPECT_NEAR(
        trajectory.duration(), 2.0 * planned_with_jerk(once, 20.0).duration() + 1.5, planner_rounding_s);
    EXPECT_NEAR(trajectory.end_of(1) - trajectory.start_of(1), 1.5, planner_rounding_s);
    EXPECT_EQ(trajectory.at(trajectory.start_of(1)).velocity.norm(), 0.0);
    EXPECT_EQ(trajectory.at(trajectory.end_of(1)).position, at_xyz(100.0));
}

TEST(Planner, LimitsTheJerkOnlyOfAxesThatMove) {
    kinematics::MachineDescription description = listing_machine().description();
    description.table.front().max_jerk = 1e-3; // a rotary axis
    const MachineModel slow_table(std::move(description));
    const Program program = moves({at_xyz(100.0)});
    EXPECT_NEAR(
        plan(program, slow_table, {}, {}).duration(), planned_path(program).duration(), planner_rounding_s);
}

TEST(Planner, SaysThatTheJerkKeepsAMoveFromBeingFaster) {
    const Trajectory trajectory = planned_with_jerk(moves({at_xyz(100.0)}), 20.0);
    EXPECT_EQ(trajectory.limit_at(0.05).limit, Limit::axis_jerk);
    EXPECT_EQ(trajectory.limit_at(0.05).axis, 0);
    EXPECT_EQ(trajectory.limit_at(0.13).limit, Limit::axis_acceleration);
    EXPECT_EQ(trajectory.limit_at(0.5 * trajectory.duration()).limit, Limit::axis_velocity);
}

/// The axes rest in a pause, exactly where the block before it ends.
void expect_rest_in_pauses(const Program& program, const Trajectory& trajectory, unsigned seed) {
    for (int n = trajectory.first_block() + 1; n <= trajectory.last_block(); ++n) {
        const program::Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.kind == BlockKind::pause) {
            const Sample rest = trajectory.at(trajectory.end_of(n));
            // The end of braking, to the rounding of its time.
            EXPECT_NEAR(rest.velocity.cwiseAbs().maxCoeff(), 0.0, 1e-9) << "seed " << seed << " block " << n;
            EXPECT_EQ(rest.position, block.target) << "seed " << seed << " block " << n;
        }
    }
}

TEST(Planner, RestsInEveryPauseWhateverComesAfterIt) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const MachineModel model = test::with_jerk(listing_machine(), seed % 2 == 0 ? 30.0 : 1e9);
        Program program = test::random_program(model, 200, seed);
        for (std::size_t n = 10; n < program.blocks.size(); n += 7) { // instead of nothing that stops
            program::Block& block = program.blocks[n];
            block.target = program.blocks[n - 1].target;
            block.kind = BlockKind::pause;
        }
        PlannerSettings settings;
        settings.path = {seed % 3 == 0 ? program::PathMode::exact_path : program::PathMode::continuous, 0.1};
        settings.look_ahead = seed % 4 == 0 ? 16 : 0;
        const Trajectory whole = plan(program, model, settings, {});
        expect_rest_in_pauses(program, whole, seed);
        const Trajectory slower = go_on(whole, 0.3 * whole.duration(), {.feed = 0.6, .rapid = 0.5});
        expect_rest_in_pauses(program, slower, seed);
        expect_rest_in_pauses(program, go_on(slower, 0.2 * slower.duration(), {.feed = 2.0}), seed);
    }
}

TEST(Planner, IsNeverSlowerThanWithALookAheadOf16Blocks) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const MachineModel model = test::with_jerk(listing_machine(), seed % 2 == 0 ? 30.0 : 1e9);
        const Program program = test::random_program(model, 200, seed);
        PlannerSettings settings;
        settings.path = {seed % 3 == 0 ? program::PathMode::exact_path : program::PathMode::continuous, 0.01};
        const double whole = plan(program, model, settings, {}).duration();
        settings.look_ahead = 16;
        const double sixteen = plan(program, model, settings, {}).duration();
        EXPECT_LE(whole, sixteen * (1.0 + 1e-12)) << "seed " << seed;
        settings.look_ahead = 1;
        EXPECT_LT(sixteen, plan(program, model, settings, {}).duration()) << "seed " << seed;
    }
}

TEST(Planner, IsNeverSlowerThanWithALookAheadOf16BlocksOnAnySample) {
    const MachineModel model = test::machine("ac-table");
    const auto samples = test::sample_programs(model);
    EXPECT_GE(samples.size(), 20U);
    PlannerSettings sixteen;
    sixteen.look_ahead = 16;
    for (const auto& [name, program] : samples) {
        EXPECT_LE(plan(program, model, {}, {}).duration(),
                  plan(program, model, sixteen, {}).duration() * (1.0 + 1e-12))
            << name;
    }
}

TEST(Planner, IsMuchFasterThanWithALookAheadOf16BlocksWhereBlocksAreShort) {
    const MachineModel model = test::machine("router-xyz");
    const auto samples = test::sample_programs(model);
    const auto found = std::ranges::find(samples, "short-blocks.ngc", &test::SampleProgram::name);
    ASSERT_NE(found, samples.end());
    PlannerSettings sixteen;
    sixteen.look_ahead = 16;
    EXPECT_LT(plan(found->program, model, {}, {}).duration(),
              0.6 * plan(found->program, model, sixteen, {}).duration());
}

TEST(Planner, StopsAfterEachMoveWithALookAheadOfOneBlock) {
    PlannerSettings settings;
    settings.look_ahead = 1;
    const double one = planned_path(moves({at_xyz(50.0)})).duration();
    EXPECT_NEAR(planned_path(moves({at_xyz(50.0), at_xyz(100.0), at_xyz(150.0)}), settings).duration(),
                3.0 * one,
                planner_rounding_s);
}

/// A cut on a dome, each block with the feed of its tip.
TEST(Planner, NeverTakesTheTipFasterOverThePartThanTheFeed) {
    const MachineModel model = listing_machine();
    Program program = test::post_over("dome", model, 8, 8).program;
    PlannerSettings settings;
    settings.feed_rule = FeedRule::on_part;
    const Trajectory trajectory = plan(program, model, settings, {});
    double closest = 0.0;
    for (int k = 0; k < 200'000; ++k) {
        const Sample sample = trajectory.at(trajectory.duration() * k / 200'000);
        const program::Block& block = program.blocks[static_cast<std::size_t>(sample.block)];
        if (block.kind == BlockKind::feed) {
            const auto J = kinematics::jacobian(model, sample.position);
            const double speed = (J.topRows<3>() * sample.velocity).norm();
            ASSERT_LE(speed, block.feed * (1.0 + 1e-9)) << "block " << sample.block;
            closest = std::max(closest, speed / block.feed);
        }
    }
    EXPECT_GT(closest, 0.98);
}

TEST(Planner, RefusesSettingsWithoutSense) {
    const auto refused = [&](auto change) {
        PlannerSettings settings;
        change(settings);
        EXPECT_THROW((void)planned_path(moves({at_xyz(1.0)}), settings), Defect);
    };
    refused([](PlannerSettings& s) { s.corner_time = -1.0; });
    refused([](PlannerSettings& s) { s.junction_deviation = -1.0; });
    refused([](PlannerSettings& s) { s.rounding_tolerance = 0.0; });
    refused([](PlannerSettings& s) { s.rounding_angle = 0.0; });
    refused([](PlannerSettings& s) { s.look_ahead = -1; });
}

TEST(Planner, StandsForADwellAndStopsForTheSpindleButNotForAComment) {
    const double through = planned_path(moves({at_xyz(100.0)})).duration();
    const double half = planned_path(moves({at_xyz(50.0)})).duration();
    const auto with = [&](BlockKind kind) {
        Program program = moves({at_xyz(50.0)});
        test::add_block(program, kind);
        program.blocks.back().duration = kind == BlockKind::dwell ? 1.5 : 0.0;
        test::add_move(program, at_xyz(100.0));
        return planned_path(program).duration();
    };
    EXPECT_NEAR(with(BlockKind::comment), through, planner_rounding_s);
    EXPECT_NEAR(with(BlockKind::spindle_on), 2.0 * half, planner_rounding_s);
    EXPECT_NEAR(with(BlockKind::dwell), 2.0 * half + 1.5, planner_rounding_s);
}

TEST(Planner, SpendsNoTimeOnMovesOfNoLength) {
    const Trajectory trajectory =
        planned_path(moves({at_xyz(50.0), at_xyz(50.0), at_xyz(50.0), at_xyz(100.0)}));
    EXPECT_NEAR(trajectory.duration(), planned_path(moves({at_xyz(100.0)})).duration(), planner_rounding_s);
    EXPECT_EQ(trajectory.end_of(1) - trajectory.start_of(1), 0.0);
}

TEST(Planner, LeavesAxesThatABlockDoesNotNameWhereTheyAre) {
    Program program = moves({at_xyz(10.0, 20.0, 30.0)});
    program.blocks[0].named = program::AxisSet::only(2);
    const Trajectory trajectory = plan(program, listing_machine(), {}, {}, at_xyz(1.0, 2.0, 3.0));
    EXPECT_EQ(trajectory.at(0.0).position, at_xyz(1.0, 2.0, 3.0));
    EXPECT_EQ(trajectory.at(trajectory.duration()).position, at_xyz(1.0, 2.0, 30.0));
}

TEST(Planner, NeverExceedsALimitOnAnyProgram) {
    for (unsigned seed = 1; seed <= 20 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const MachineModel model = listing_machine();
        const Trajectory trajectory = planned_path(test::random_program(model, 150, seed));
        test::expect_within_limits(trajectory, model, 0.002, 10'000);
    }
}

TEST(Planner, NeverExceedsALimitOnADome) {
    const MachineModel model = listing_machine();
    const Program program = test::post_over("dome", model, 20, 20).program;
    test::expect_within_limits(planned_path(program), model, 0.002, 50'000);
}

/// The greatest speeds on a chain of straight ways, cut into many small steps: relaxed until nothing changes.
/// Shares nothing with the planner but the statement of the problem.
double relaxed_duration(const std::vector<AxisPositions>& corners, double corner_time) {
    constexpr int cuts = 4000;
    const std::array<double, 3> v{250.0, 250.0, 200.0};
    const std::array<double, 3> a{1500.0, 1500.0, 1200.0};
    std::vector<double> cap;  // of the squared speed in mm/s at each knot
    std::vector<double> gain; // of squared speed a step
    std::vector<double> step;
    for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg) {
        const Vec3 d = (corners[leg + 1] - corners[leg]).head<3>();
        double top = std::numeric_limits<double>::infinity();
        double most = top;
        for (Eigen::Index n = 0; n < 3; ++n) {
            const double share = std::abs(d[n]) / d.norm();
            top = share > 0.0 ? std::min(top, v[static_cast<std::size_t>(n)] / share) : top;
            most = share > 0.0 ? std::min(most, a[static_cast<std::size_t>(n)] / share) : most;
        }
        for (int k = 0; k < cuts; ++k) {
            cap.push_back(top * top);
            step.push_back(d.norm() / cuts);
            gain.push_back(2.0 * most * step.back());
        }
    }
    cap.push_back(0.0);
    cap.front() = 0.0;
    // In a corner speed is not one number on both sides: the leg's own scale of speed carries it over. The
    // corners of this test turn between legs of equal scale, so one number will do.
    for (std::size_t leg = 1; leg + 1 < corners.size(); ++leg) {
        const Vec3 in = (corners[leg] - corners[leg - 1]).head<3>().normalized();
        const Vec3 out = (corners[leg + 1] - corners[leg]).head<3>().normalized();
        double speed = std::numeric_limits<double>::infinity();
        for (Eigen::Index n = 0; n < 3; ++n) {
            const double turn = std::abs(in[n] - out[n]);
            speed = turn > 0.0 ? std::min(speed, a[static_cast<std::size_t>(n)] * corner_time / turn) : speed;
        }
        double& knot = cap[leg * cuts];
        knot = std::min(knot, speed * speed);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t k = 0; k + 1 < cap.size(); ++k) {
            const double forward = std::min(cap[k + 1], cap[k] + gain[k]);
            changed = changed || forward < cap[k + 1];
            cap[k + 1] = forward;
        }
        for (std::size_t k = cap.size() - 1; k > 0; --k) {
            const double backward = std::min(cap[k - 1], cap[k] + gain[k - 1]);
            changed = changed || backward < cap[k - 1];
            cap[k - 1] = backward;
        }
    }
    double time = 0.0;
    for (std::size_t k = 0; k + 1 < cap.size(); ++k) {
        time += 2.0 * step[k] / (std::sqrt(cap[k]) + std::sqrt(cap[k + 1]));
    }
    return time;
}

TEST(Planner, IsAsFastAsABruteForceSearch) {
    // X and Y are alike, so that a millimetre counts the same on every leg.
    const std::vector<AxisPositions> corners{at_xyz(0.0),
                                             at_xyz(30.0),
                                             at_xyz(30.5, 0.2),
                                             at_xyz(31.0, 0.4),
                                             at_xyz(31.0, 5.0),
                                             at_xyz(80.0, 6.0),
                                             at_xyz(81.0, 90.0)};
    Program program = moves({corners.begin() + 1, corners.end()});
    const double exact = planned_path(program).duration();
    EXPECT_NEAR(relaxed_duration(corners, 0.002), exact, 1e-3 * exact);
}

TEST(Planner, RefusesAProgramOfOtherAxes) {
    Program program = moves({at_xyz(1.0)});
    program.axes[3].letter = 'C';
    EXPECT_THROW((void)planned_path(program), Error);
    program.axes.pop_back();
    EXPECT_THROW((void)planned_path(program), Error);
}

TEST(Planner, RefusesTargetsThatAreNotFinite) {
    Program program = moves({at_xyz(1.0)});
    program.blocks[0].target[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)planned_path(program), Defect);
}

TEST(Planner, CanBeCancelled) {
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW((void)plan(moves({at_xyz(1.0)}), listing_machine(), {}, Progress({}, source.get_token())),
                 Cancelled);
}

} // namespace
} // namespace millwright::motion
