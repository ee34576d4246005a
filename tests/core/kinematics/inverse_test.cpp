#include "core/kinematics/inverse.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/rotary_tilt.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

namespace millwright::kinematics {
namespace {

geometry::ToolPose random_pose(std::mt19937& random) {
    return {test::random_point(random, 100.0), test::random_upward(random)};
}

class InverseKinematics : public ::testing::TestWithParam<const char*> {
protected:
    MachineModel machine_ = test::machine(GetParam());
    AxisPositions zero_ = AxisPositions::Zero(5);
};

// T5.
TEST_P(InverseKinematics, EveryBranchReturnsToThePose) {
    std::mt19937 random(1997);
    for (int n = 0; n < 1000; ++n) {
        const auto pose = random_pose(random);
        const auto branches = inverse_branches(machine_, pose, zero_);
        ASSERT_EQ(branches.size(), 2U);
        for (const AxisPositions& q : branches) {
            const auto back = forward(machine_, q);
            EXPECT_LT((back.tip - pose.tip).norm(), round_trip_mm);
            EXPECT_LT((back.axis - pose.axis).norm(), 1e-12);
        }
    }
}

TEST_P(InverseKinematics, FindsThePositionThatMadeThePose) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> tilt(0.1, 1.4);
    std::uniform_real_distribution<double> turn(-pi, pi);
    for (int n = 0; n < 500; ++n) {
        AxisPositions q(5);
        q << test::random_point(random, 100.0), 0.0, 0.0;
        q[machine_.rotary_axes()[0]] = tilt(random) - machine_.axis(machine_.rotary_axes()[0]).zero_offset;
        q[machine_.rotary_axes()[1]] = turn(random);
        const auto solution = inverse(machine_, forward(machine_, q), q);
        ASSERT_FALSE(solution.branches.empty()) << solution.why;
        double nearest = 1e300;
        for (const AxisPositions& branch : solution.branches) {
            nearest = std::min(nearest, (branch - q).norm());
        }
        EXPECT_LT(nearest, 1e-9);
    }
}

TEST_P(InverseKinematics, KeepsTheFreeAngleAtAPole) {
    AxisPositions previous = zero_;
    previous[machine_.rotary_axes()[1]] = 1.234;
    const auto solution = inverse(machine_, {Vec3(10, 20, 30), pole_direction(machine_)}, previous);
    // A table axis that turns the other way has the same pole below; the tool axis comes from above.
    const auto above = inverse(machine_, {Vec3(10, 20, 30), Vec3::UnitZ()}, previous);
    ASSERT_FALSE(above.branches.empty()) << above.why;
    EXPECT_EQ(above.reach, Reach::singular);
    for (const AxisPositions& q : above.branches) {
        EXPECT_DOUBLE_EQ(q[machine_.rotary_axes()[1]], 1.234);
        EXPECT_LT((forward(machine_, q).tip - Vec3(10, 20, 30)).norm(), round_trip_mm);
    }
}

TEST_P(InverseKinematics, StaysInTheTurnOfAnAxisWithoutLimits) {
    AxisPositions previous = zero_;
    previous[machine_.rotary_axes()[1]] = 7.0 * pi;
    std::mt19937 random(8);
    for (int n = 0; n < 100; ++n) {
        for (const AxisPositions& q : inverse(machine_, random_pose(random), previous).branches) {
            EXPECT_LE(std::abs(q[machine_.rotary_axes()[1]] - 7.0 * pi), pi + 1e-12);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Machines,
                         InverseKinematics,
                         ::testing::Values("rotary-tilt-listing", "rotary-tilt-gui", "ac-table"));

// T5.
TEST(InverseKinematics, EqualsTheThesisInConsistentMode) {
    const MachineModel machine = test::machine("rotary-tilt-listing");
    std::mt19937 random(9);
    for (int n = 0; n < 500; ++n) {
        const auto pose = random_pose(random);
        const RotaryTiltAngles angles = rotary_tilt_angles(AngleMode::consistent, pose.axis);
        AxisPositions thesis(5);
        thesis << machine_from_workpiece(listing_values, pose.tip, angles.A, angles.B), angles.A, angles.B;
        const auto branches = inverse_branches(machine, pose, thesis);
        EXPECT_LT((nearest_branch(machine, branches, thesis) - thesis).norm(), 1e-9);
    }
}

TEST(InverseKinematics, AnswersOutsideLimitsWithTheAxisAndTheRange) {
    const MachineModel machine = test::machine("ac-table");
    const auto far = inverse(machine, {Vec3(0, 0, 900), Vec3::UnitZ()}, AxisPositions::Zero(5));
    EXPECT_EQ(far.reach, Reach::outside_limits);
    EXPECT_NE(far.why.find("axis Z"), std::string::npos) << far.why;
    const Vec3 upside_down = Vec3(0.1, 0.0, -1.0).normalized();
    const auto below = inverse(machine, {Vec3::Zero(), upside_down}, AxisPositions::Zero(5));
    EXPECT_EQ(below.reach, Reach::outside_limits);
    EXPECT_NE(below.why.find("axis A"), std::string::npos) << below.why;
}

// 237.844 deg was reported for a position at -122.156, two degrees beyond the limit.
TEST(InverseKinematics, OutsideLimitsTellsTheTurnThatIsNearestToThem) {
    const MachineModel machine = test::machine("ac-table"); // A within 120 deg
    AxisPositions there = AxisPositions::Zero(5);
    const int a = machine.rotary_axes()[0];
    there[a] = from_degrees(-122.156);
    const auto pose = forward(machine, there);
    for (const double before_deg : {-100.0, 0.0, 100.0}) {
        AxisPositions previous = AxisPositions::Zero(5);
        previous[a] = from_degrees(before_deg);
        const auto solution = inverse(machine, pose, previous);
        EXPECT_EQ(solution.reach, Reach::outside_limits);
        EXPECT_NE(solution.why.find("122.156, outside -120.000 ... 120.000 deg"), std::string::npos)
            << before_deg << ": " << solution.why;
    }
}

TEST(InverseKinematics, OfAThreeAxisMachineReachesOnlyTheToolAxis) {
    MachineDescription description = test::machine("ac-table").description();
    description.table.clear();
    description.bodies.clear();
    const MachineModel machine{description};
    const AxisPositions zero = AxisPositions::Zero(3);
    EXPECT_EQ(inverse(machine, {Vec3(1, 2, 3), Vec3::UnitZ()}, zero).branches.size(), 1U);
    EXPECT_EQ(inverse(machine, {Vec3(1, 2, 3), Vec3::UnitX()}, zero).reach, Reach::unreachable);
}

TEST(InverseKinematics, ReportsWhatATiltedAxisCannotReach) {
    // A nutating table: the turning axis leans 45 deg, so the tool reaches only half of the directions.
    MachineDescription description = test::machine("ac-table").description();
    description.table[0].direction = Vec3(0, 1, 1).normalized();
    description.table[0].min = -10.0;
    description.table[0].max = 10.0;
    description.bodies.clear();
    const MachineModel machine{description};
    const AxisPositions zero = AxisPositions::Zero(5);
    EXPECT_EQ(inverse(machine, {Vec3::Zero(), Vec3(0.1, 0, -1).normalized()}, zero).reach,
              Reach::unreachable);
    const auto reachable = inverse(machine, {Vec3::Zero(), Vec3(0.3, 0.4, 0.8).normalized()}, zero);
    ASSERT_EQ(reachable.reach, Reach::reachable);
    for (const AxisPositions& q : reachable.branches) {
        EXPECT_LT((forward(machine, q).axis - Vec3(0.3, 0.4, 0.8).normalized()).norm(), 1e-12);
    }
}

TEST(InverseKinematics, GivesEveryTurnThatFitsTheLimits) {
    MachineDescription description = test::machine("ac-table").description();
    description.table[1].min = -2.0 * pi;
    description.table[1].max = 2.0 * pi;
    const MachineModel machine{description};
    const auto solution =
        inverse(machine, {Vec3::Zero(), Vec3(0.3, 0.4, 0.8).normalized()}, AxisPositions::Zero(5));
    EXPECT_EQ(solution.branches.size(), 4U); // two branches of A, two turns of C each
    EXPECT_TRUE(std::is_sorted(solution.branches.begin(),
                               solution.branches.end(),
                               [](const AxisPositions& a, const AxisPositions& b) {
                                   return std::lexicographical_compare(
                                       a.begin(), a.end(), b.begin(), b.end());
                               }));
}

TEST(InverseKinematics, RefusesAPoseThatIsNone) {
    const MachineModel machine = test::machine("ac-table");
    const AxisPositions zero = AxisPositions::Zero(5);
    EXPECT_THROW((void)inverse(machine, {Vec3::Zero(), Vec3(0, 0, 2)}, zero), Defect);
    EXPECT_THROW((void)inverse(machine, {Vec3(std::nan(""), 0, 0), Vec3::UnitZ()}, zero), Defect);
}

} // namespace
} // namespace millwright::kinematics
