#include "core/toolpath/shortest_sequence.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;
using kinematics::AxisPositions;
using kinematics::MachineModel;

constexpr double sequence_feed = 10.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

Toolpath path_on(const char* preset, int nu, int nv) {
    return zigzag(test::patch(preset), Grid::uniform(nu, nv), TrackDirection::along_u, false);
}

/// The A-on-C table whose C turns `deg` both ways.
MachineModel limited_table(double deg) {
    kinematics::MachineDescription description = test::machine("ac-table").description();
    description.table.at(1).min = -from_degrees(deg);
    description.table.at(1).max = from_degrees(deg);
    return MachineModel(description);
}

Toolpath random_path(unsigned seed, int points) {
    std::mt19937 random(seed);
    Toolpath path;
    for (int n = 0; n < points; ++n) {
        const bool track = n % 4 != 0;
        path.points.push_back({{test::random_point(random, 40.0), test::random_upward(random)},
                               n == 0  ? MoveKind::start
                               : track ? MoveKind::track
                                       : MoveKind::cross,
                               {}});
    }
    return path;
}

/// One track round the vertical: a cone of normals, `deg` from its first to its last point.
Toolpath round_the_pole(int points, double deg) {
    Toolpath path;
    for (int n = 0; n < points; ++n) {
        const double azimuth = from_degrees(90.0 + deg * n / (points - 1)); // C begins at 0 or 180
        const Vec3 axis(0.5 * std::cos(azimuth), 0.5 * std::sin(azimuth), std::sqrt(0.75));
        path.points.push_back({{20.0 * axis, axis}, n == 0 ? MoveKind::start : MoveKind::track, {}});
    }
    return path;
}

/// Every way through every branch and turn, tried one by one; an axis without limits up to two turns away.
class EveryWay {
public:
    EveryWay(const MachineModel& machine, const Toolpath& path, const StepCosts& costs, double link_share)
        : machine_(machine), path_(path), costs_(costs), link_share_(link_share) {}

    [[nodiscard]] double least() {
        go(AxisPath{});
        return least_;
    }

private:
    [[nodiscard]] std::vector<AxisPositions> places(std::size_t n) const {
        const AxisPositions zero = AxisPositions::Zero(machine_.axis_count());
        std::vector<AxisPositions> all;
        for (const AxisPositions& found :
             kinematics::inverse(machine_, path_.points[n].pose, zero).branches) {
            for (int turn = -2; turn <= 2; ++turn) {
                AxisPositions moved = found;
                for (const int axis : machine_.rotary_axes()) {
                    moved[axis] += std::isinf(machine_.axis(axis).max) ? 2.0 * pi * turn : 0.0;
                }
                all.push_back(moved);
            }
        }
        return all;
    }
    void go(const AxisPath& so_far) {
        const std::size_t n = so_far.positions.size();
        if (n == path_.points.size()) {
            least_ = std::min(least_, cost_of(machine_, path_, so_far, costs_, link_share_));
            return;
        }
        for (const AxisPositions& place : places(n)) {
            AxisPath further = so_far;
            further.positions.push_back(place);
            go(further);
        }
    }

    const MachineModel& machine_;
    const Toolpath& path_;
    const StepCosts& costs_;
    double link_share_;
    double least_ = infinity;
};

class EachMachine : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(
    ShortestSequence,
    EachMachine,
    ::testing::Values("rotary-tilt-listing", "ac-table", "bc-table-head", "ca-head", "tilted-c-table"));

TEST_P(EachMachine, ReachesEveryPoseInsideTheLimits) {
    const MachineModel machine = test::machine(GetParam());
    const Toolpath path = path_on("two-bell", 9, 8);
    for (const StepCosts& costs : {travel_costs(machine), time_costs(machine, path, sequence_feed)}) {
        const AxisPath axes = shortest_sequence(machine, path, costs, 1.0, {});
        ASSERT_EQ(axes.positions.size(), path.points.size());
        for (std::size_t n = 0; n < path.points.size(); ++n) {
            const auto pose = kinematics::forward(machine, axes.positions[n]);
            EXPECT_LT((pose.tip - path.points[n].pose.tip).norm(), kinematics::round_trip_mm);
            EXPECT_LT(angle_between(pose.axis, path.points[n].pose.axis), 1e-6);
            for (int axis = 0; axis < machine.axis_count(); ++axis) {
                EXPECT_GE(axes.positions[n][axis], machine.axis(axis).min);
                EXPECT_LE(axes.positions[n][axis], machine.axis(axis).max);
            }
        }
    }
}

TEST_P(EachMachine, IsTheBestOfEveryWay) {
    const MachineModel machine = test::machine(GetParam());
    const std::vector weights{0.01, 0.02, 0.03, 0.4, 1.0};
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Toolpath path = random_path(seed, 4);
        for (const StepCosts& costs : {travel_costs(machine),
                                       travel_costs(machine, weights),
                                       time_costs(machine, path, sequence_feed)}) {
            for (const double share : {1.0, 0.0}) {
                const AxisPath axes = shortest_sequence(machine, path, costs, share, {});
                EXPECT_NEAR(cost_of(machine, path, axes, costs, share),
                            EveryWay(machine, path, costs, share).least(),
                            1e-8)
                    << seed;
            }
        }
    }
}

// T10.
TEST(ShortestSequence, IsTheBestOfEveryWayThroughTurnsInsideLimits) {
    const MachineModel machine = limited_table(500.0);
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Toolpath path = random_path(seed, 4);
        const StepCosts costs = travel_costs(machine);
        const AxisPath axes = shortest_sequence(machine, path, costs, 1.0, {});
        EXPECT_GE(feasible_rotations(machine, path).front().size(), 4U) << "branches and turns";
        EXPECT_NEAR(
            cost_of(machine, path, axes, costs, 1.0), EveryWay(machine, path, costs, 1.0).least(), 1e-8);
    }
}

TEST_P(EachMachine, HasTheLeastErrorOfEveryWay) {
    const MachineModel machine = test::machine(GetParam());
    const Toolpath path = path_on("two-bell", 6, 5);
    const Toolpath head{
        path.direction, path.tool, {path.points.begin() + 6, path.points.begin() + 10}}; // off the poles
    const StepCosts costs = error_costs(test::patch("two-bell"), machine, head, {}, grid::coarse);
    const AxisPath axes = shortest_sequence(machine, head, costs, 0.0, {});
    const double least = EveryWay(machine, head, costs, 0.0).least();
    EXPECT_NEAR(cost_of(machine, head, axes, costs, 0.0), least, 1e-8 * (1.0 + least));
}

TEST_P(EachMachine, IsNeverWorseThanOnePointAfterAnother) {
    const MachineModel machine = test::machine(GetParam());
    for (const char* preset : {"dome", "sine", "two-bell", "saddle"}) {
        const Toolpath path = path_on(preset, 12, 9);
        const AxisPath greedy = sequence(machine, path);
        const double share = 0.5;
        for (const StepCosts& costs : {travel_costs(machine),
                                       time_costs(machine, path, sequence_feed),
                                       error_costs(test::patch(preset), machine, path, {}, grid::coarse)}) {
            const AxisPath best = shortest_sequence(machine, path, costs, share, {});
            EXPECT_LE(cost_of(machine, path, best, costs, share),
                      cost_of(machine, path, greedy, costs, share) * (1.0 + 1e-12))
                << preset;
        }
    }
}

TEST(ShortestSequence, SeesALimitThatOnePointAfterAnotherRunsInto) {
    const MachineModel machine = limited_table(200.0);
    const Toolpath path = round_the_pole(31, 300.0);
    const AxisPath greedy = sequence(machine, path);
    EXPECT_GT(largest_rotary_step(machine, path, greedy, MoveKind::track), from_degrees(150.0))
        << "it has to unwind in the middle of the cut";
    const AxisPath best = shortest_sequence(machine, path, travel_costs(machine), 1.0, {});
    EXPECT_NEAR(largest_rotary_step(machine, path, best, MoveKind::track), from_degrees(10.0), 1e-9);
    EXPECT_NEAR(best.rotary_travel, from_degrees(300.0), 1e-9);
    EXPECT_GT(greedy.rotary_travel, best.rotary_travel + from_degrees(100.0));
}

TEST(ShortestSequence, WindsAnEndlessAxisOnAndOn) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = round_the_pole(91, 900.0);
    const AxisPath best = shortest_sequence(machine, path, travel_costs(machine), 1.0, {});
    EXPECT_NEAR(best.rotary_travel, from_degrees(900.0), 1e-9);
    const int C = machine.axis_index('C');
    EXPECT_NEAR(std::abs(best.positions.back()[C] - best.positions.front()[C]), from_degrees(900.0), 1e-9);
}

TEST(ShortestSequence, TurnsTheFreeAxisOnTheWayToATrackThatBeginsOnAPole) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = path_on("two-bell", 12, 6); // the corners are poles
    for (const StepCosts& costs : {travel_costs(machine), time_costs(machine, path, sequence_feed)}) {
        const AxisPath axes = shortest_sequence(machine, path, costs, 1.0, {});
        const int C = machine.axis_index('C');
        EXPECT_NEAR(axes.positions[0][C], axes.positions[1][C], 1e-9) << "the first point is one";
    }
}

TEST(ShortestSequence, DoesNotTurnTheFreeAxisOnThePole) {
    const MachineModel machine = test::machine("ac-table");
    Toolpath path;
    for (int n = -2; n <= 2; ++n) {
        const double tilt = from_degrees(10.0 * n);
        const Vec3 axis(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt));
        path.points.push_back({{Vec3::Zero(), axis}, n == -2 ? MoveKind::start : MoveKind::track, {}});
    }
    const AxisPath best = shortest_sequence(machine, path, travel_costs(machine), 1.0, {});
    EXPECT_NEAR(best.rotary_travel, from_degrees(40.0), 1e-9) << "only A tilts, from side to side";
    const Toolpath flat{path.direction, {}, {path.points[2], path.points[2]}};
    EXPECT_EQ(shortest_sequence(machine, flat, travel_costs(machine), 1.0, {}).rotary_travel, 0.0);
}

TEST(ShortestSequence, ATrackReachedOffThePartIsFreeToBeginOnAnyBranch) {
    const MachineModel machine = limited_table(200.0);
    Toolpath path = round_the_pole(31, 300.0);
    Toolpath twice = path;
    twice.points.insert(twice.points.end(), path.points.begin(), path.points.end());
    twice.points[path.points.size()].reached_by = MoveKind::cross;
    const StepCosts costs = travel_costs(machine);
    const auto cost = [&](const Toolpath& of) {
        return cost_of(machine, of, shortest_sequence(machine, of, costs, 0.0, {}), costs, 0.0);
    };
    EXPECT_NEAR(cost(twice), 2.0 * cost(path), 1e-6);
    const AxisPath on_the_part = shortest_sequence(machine, twice, costs, 1.0, {});
    EXPECT_GT(on_the_part.rotary_travel, from_degrees(600.0)) << "the way back counts";
}

TEST(ShortestSequence, SaysWhichPointCannotBeReached) {
    const auto far = test::machine("ac-table").with_workpiece_offset({0, 2000, 0});
    const Toolpath path = path_on("dome", 4, 4);
    try {
        (void)shortest_sequence(far, path, travel_costs(far), 1.0, {});
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("path point"), std::string::npos);
        EXPECT_NE(error.diagnostic().message.find("outside"), std::string::npos);
    }
    const MachineModel machine = test::machine("ac-table");
    const StepCosts never = [](std::size_t n) -> StepCost {
        return [n](const AxisPositions&, const AxisPositions&) { return n == 3 ? infinity : 1.0; };
    };
    try {
        (void)shortest_sequence(machine, path, never, 1.0, {});
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("path point 3"), std::string::npos);
    }
}

TEST(ShortestSequence, CanBeCancelledAndRefusesWhatMakesNoSense) {
    const MachineModel machine = test::machine("ac-table");
    const Toolpath path = path_on("dome", 4, 4);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(
        (void)shortest_sequence(machine, path, travel_costs(machine), 1.0, Progress({}, stop.get_token())),
        Cancelled);
    EXPECT_THROW((void)shortest_sequence(machine, path, travel_costs(machine), 1.5, {}), Defect);
    EXPECT_THROW((void)travel_costs(machine, {1.0}), Defect);
    EXPECT_THROW((void)travel_costs(machine, {1.0, -1.0, 1.0, 1.0, 1.0}), Defect);
    EXPECT_THROW((void)time_costs(machine, path, 0.0), Defect);
    EXPECT_TRUE(shortest_sequence(machine, {}, travel_costs(machine), 1.0, {}).positions.empty());
}

} // namespace
} // namespace millwright::toolpath
