#include "core/toolpath/actual_trajectory.h"

#include "core/base/error.h"
#include "core/kinematics/rotary_tilt.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <complex>

namespace millwright::toolpath {
namespace {

using kinematics::AxisPositions;

// T8.
TEST(ActualTrajectory, StartsAndEndsExactlyAtThePoses) {
    const auto machine = test::machine("rotary-tilt-listing");
    AxisPositions a(5), b(5);
    a << 10, 20, 30, 0.3, 1.2;
    b << 15, 22, 28, 0.5, 1.0;
    const auto poses = actual_poses(machine, a, b, 11);
    ASSERT_EQ(poses.size(), 11U);
    EXPECT_EQ(poses.front().tip, actual_pose(machine, a, b, 0.0).tip);
    EXPECT_LT((poses[5].tip - actual_pose(machine, a, b, 0.5).tip).norm(), 1e-12);
    EXPECT_THROW((void)actual_poses(machine, a, b, 1), Defect);
}

/// The closed form of the mid-point's deviation for constant A: with V = h + i q the true middle is
/// V/2 = mean - mean (1 - cos(dB/2)) - i/2 dV sin(dB/2).
TEST(ActualTrajectory, MidPointDeviationEqualsTheClosedForm) {
    const auto machine = test::machine("rotary-tilt-listing");
    const auto& set = kinematics::listing_values;
    std::mt19937 random(12);
    std::uniform_real_distribution<double> angle(0.2, 2.8);
    for (int n = 0; n < 200; ++n) {
        const Vec3 p1 = test::random_point(random, 50.0), p2 = test::random_point(random, 50.0);
        const double A = angle(random) - 1.5, B1 = angle(random), B2 = angle(random);
        AxisPositions a(5), b(5);
        a << machine_from_workpiece(set, p1, A, B1), A, B1;
        b << machine_from_workpiece(set, p2, A, B2), A, B2;
        const auto plane = [&](const Vec3& p) {
            const double q = set.e + (set.a + p.x()) * std::cos(A) - (set.b + p.y()) * std::sin(A);
            return std::complex<double>(set.AB - set.c - p.z(), q);
        };
        const std::complex<double> mean = 0.5 * (plane(p1) + plane(p2)), step = plane(p2) - plane(p1);
        const double dB = B2 - B1;
        const std::complex<double> closed =
            -mean * (1.0 - std::cos(dB / 2.0)) - std::complex<double>(0.0, 0.5) * step * std::sin(dB / 2.0);
        const std::complex<double> actual = plane(actual_pose(machine, a, b, 0.5).tip) - mean;
        EXPECT_LT(std::abs(actual - closed), 1e-11);
    }
}

TEST(ActualTrajectory, IsStraightWhileNoRotaryAxisMoves) {
    const auto machine = test::machine("ac-table");
    AxisPositions a(5), b(5);
    a << 10, 20, 30, 0.3, 1.2;
    b << -10, 25, 10, 0.3, 1.2;
    const auto poses = actual_poses(machine, a, b, 21);
    const Vec3 along = (poses.back().tip - poses.front().tip).normalized();
    for (const auto& pose : poses) {
        EXPECT_LT((pose.tip - poses.front().tip).cross(along).norm(), 1e-12);
    }
}

} // namespace
} // namespace millwright::toolpath
