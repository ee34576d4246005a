#include "core/motion/path.h"

#include "core/kinematics/forward.h"
#include "core/motion/planner.h"
#include "tests/support/motions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::motion {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;

PlannerSettings rounded(double tolerance) {
    PlannerSettings settings;
    settings.path = {program::PathMode::continuous, tolerance};
    return settings;
}

Path rounded_path(const MachineModel& machine, unsigned seed, double tolerance) {
    return plan(test::random_program(machine, 100, seed), machine, rounded(tolerance), {}).path();
}

struct Place {
    int block = 0;
    double offset = 0.0;
};

std::vector<Place> places_on(const Path& path, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Place> places;
    for (int block = 0; block < path.block_count(); ++block) {
        const Segment& segment = path.segments[static_cast<std::size_t>(block)];
        for (int k = 0; k < 20 && segment.length > 0.0; ++k) {
            const double rounding = k % 2 == 0 ? segment.rounding_start : segment.rounding_end;
            const double near = share(random) * (k < 10 && rounding > 0.0 ? rounding : segment.length);
            places.push_back({block, k % 2 == 0 ? near : segment.length - near});
        }
    }
    return places;
}

TEST(RoundedPath, KeepsTheTipWithinTheToleranceOfTheProgrammedPath) {
    for (const double tolerance : {0.001, 0.01, 0.1, 1.0}) {
        const MachineModel machine = test::machine("ac-table");
        for (unsigned seed = 1; seed <= 10; ++seed) {
            const Path path = rounded_path(machine, seed, tolerance);
            double farthest = 0.0;
            for (const Place& place : places_on(path, seed)) {
                const auto n = static_cast<std::size_t>(place.block);
                const double share = place.offset / path.segments[n].length;
                const AxisPositions straight =
                    path.positions[n] + share * (path.positions[n + 1] - path.positions[n]);
                const AxisPositions there = path.at(place.block, place.offset).position;
                const Vec3 off =
                    kinematics::forward(machine, there).tip - kinematics::forward(machine, straight).tip;
                farthest = std::max(farthest, off.norm());
                EXPECT_LE(std::abs(there[3] - straight[3]), PlannerSettings{}.rounding_angle + 1e-12);
                EXPECT_LE(std::abs(there[4] - straight[4]), PlannerSettings{}.rounding_angle + 1e-12);
            }
            EXPECT_LE(farthest, tolerance) << "seed " << seed;
        }
    }
}

TEST(RoundedPath, UsesTheToleranceInASharpCorner) {
    const MachineModel machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    AxisPositions q = program.start;
    q[0] = 50.0;
    test::add_move(program, q, 1.0);
    q[1] = 50.0;
    test::add_move(program, q, 1.0);
    const Trajectory trajectory = plan(program, machine, rounded(0.5), {});
    const AxisPositions middle = trajectory.at(trajectory.end_of(0)).position;
    EXPECT_NEAR(std::hypot(50.0 - middle[0], middle[1]), 0.5, 1e-9);
}

TEST(RoundedPath, HasTheDerivativesOfItsPositions) {
    const MachineModel machine = test::machine("ac-table");
    const Path path = rounded_path(machine, 3, 0.1);
    for (const Place& place : places_on(path, 3)) {
        const Segment& segment = path.segments[static_cast<std::size_t>(place.block)];
        double shortest = segment.length;
        for (const double rounding : {segment.rounding_start, segment.rounding_end}) {
            shortest = rounding > 0.0 ? std::min(shortest, rounding) : shortest;
        }
        const double h = 1e-4 * shortest;
        constexpr double too_short = 1e-9; // for positions that are rounded to 1e-14 mm
        if (h < too_short || place.offset < h || place.offset > segment.length - h) {
            continue;
        }
        const PathDerivatives now = path.at(place.block, place.offset);
        const PathDerivatives before = path.at(place.block, place.offset - h);
        const PathDerivatives after = path.at(place.block, place.offset + h);
        const double scale = now.first.norm() + 1.0;
        EXPECT_LT(((after.position - before.position) / (2.0 * h) - now.first).norm(), 1e-3 * scale);
        EXPECT_LT(((after.first - before.first) / 2.0 - h * now.second).norm(), 1e-3 * scale);
        EXPECT_LT(((after.second - before.second) * h / 2.0 - h * h * now.third).norm(), 1e-3 * scale);
    }
}

TEST(RoundedPath, IsSmoothWhereBlocksMeet) {
    const MachineModel machine = test::machine("ac-table");
    const Path path = rounded_path(machine, 5, 0.1);
    int roundings = 0;
    for (int block = 0; block < path.block_count(); ++block) {
        const Segment& segment = path.segments[static_cast<std::size_t>(block)];
        if (segment.rounding_end > 0.0) {
            const PathDerivatives end = path.at(block, segment.length);
            const PathDerivatives begin = path.at(segment.after, 0.0);
            EXPECT_LT((end.position - begin.position).norm(), 1e-9);
            EXPECT_LT((end.first - begin.first).norm(), 1e-9 * end.first.norm());
            EXPECT_LT((end.second - begin.second).norm(), 1e-9 * end.second.norm());
            ++roundings;
        }
    }
    EXPECT_GT(roundings, 20);
}

TEST(RoundedPath, IsTheProgrammedOneInExactPathMode) {
    const MachineModel machine = test::machine("ac-table");
    const Path path = plan(test::random_program(machine, 50, 1), machine, {}, {}).path();
    for (int block = 0; block < path.block_count(); ++block) {
        const auto n = static_cast<std::size_t>(block);
        EXPECT_EQ(path.at(block, path.segments[n].length).position, path.positions[n + 1]);
        EXPECT_EQ(path.segments[n].rounding_end, 0.0);
    }
}

} // namespace
} // namespace millwright::motion
