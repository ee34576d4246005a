#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace millwright::kinematics {

namespace {

TEST(ToolRoll, IsThatOfTheFrameWithThatRoll) {
    std::mt19937 random(2);
    std::normal_distribution<double> any;
    for (int n = 0; n < 100; ++n) {
        const Vec3 axis = n < 2 ? Vec3(0.0, 0.0, n == 0 ? 1.0 : -1.0)
                                : Vec3(any(random), any(random), any(random)).normalized();
        const double roll = std::uniform_real_distribution<double>(-3.1, 3.1)(random);
        const Mat3 frame = frame_with_roll(axis, roll);
        EXPECT_TRUE(frame.isUnitary(1e-12));
        EXPECT_NEAR(frame.determinant(), 1.0, 1e-12);
        EXPECT_LT((frame.col(2) - axis).norm(), 1e-12);
        EXPECT_NEAR(roll_of(frame), roll, 1e-9);
    }
}

TEST(ToolRoll, IsCountedFromTheShortestTurnOfTheBaseForward) {
    const auto x = [](const Vec3& axis) { return Vec3(frame_with_roll(axis, 0.0).col(0)); };
    for (const double azimuth : {0.0, 1.0, -2.0, 3.1}) { // a level tool has its x down
        const Vec3 level(std::cos(azimuth), std::sin(azimuth), 0.0);
        EXPECT_LT((x(level) + Vec3::UnitZ()).norm(), 1e-12);
    }
    EXPECT_LT((x(Vec3::UnitZ()) - Vec3::UnitX()).norm(), 1e-12);
    EXPECT_LT((x(-Vec3::UnitZ()) + Vec3::UnitX()).norm(), 1e-12);
    EXPECT_LT((x(-Vec3::UnitX()) - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_LT((frame_with_roll(Vec3::UnitX(), 0.5 * pi).col(0) - Vec3::UnitY()).norm(), 1e-12);
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    for (int n = 0; n < 100; ++n) {
        const Vec3 axis = Vec3(any(random), any(random), any(random)).normalized();
        const Vec3 turned = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis) * -Vec3::UnitZ();
        EXPECT_LT((x(axis) - turned).norm(), 1e-9) << axis.transpose();
    }
}

// The read-out of half a turn went from -180 to 180 and back.
TEST(ToolRoll, OfHalfATurnIsOneNumber) {
    for (const double roll : {-pi, -pi + 1e-12, pi - 1e-12, pi}) {
        EXPECT_NEAR(roll_of(frame_with_roll(Vec3(0.6, 0.0, 0.8), roll)), pi, 1e-9);
    }
}

/// The largest step of the roll, degrees, while the tool is tilted by 40 degrees one way, over the direction
/// `beside` the `middle`, and 40 degrees to the other side, without being turned about its own axis.
double largest_step_past(const Vec3& middle, const Vec3& side, double beside) {
    const Vec3 about = middle.cross(side).normalized();
    const Mat3 lean = Eigen::AngleAxisd(beside, side).toRotationMatrix();
    const Vec3 first = Eigen::AngleAxisd(from_degrees(-40.0), about) * middle;
    const Mat3 start = lean * frame_with_roll(first, 0.3);
    double largest = 0.0, before = roll_of(start);
    for (double turn = 0.1; turn <= 80.0; turn += 0.1) {
        const Mat3 now =
            lean * Eigen::AngleAxisd(from_degrees(turn), about).toRotationMatrix() * lean.transpose() * start;
        const double roll = roll_of(now);
        largest = std::max(largest, std::abs(to_degrees(std::remainder(roll - before, 2.0 * pi))));
        before = roll;
    }
    return largest;
}

TEST(ToolRoll, DoesNotJumpWhereATiltPassesThroughOrBesideTheUprightTool) {
    for (const Vec3& middle : {Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ())}) {
        for (const Vec3& side :
             {Vec3(Vec3::UnitX()), Vec3(-Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(-Vec3::UnitY())}) {
            for (const double beside : {0.0, 1e-12, 1e-9, 1e-6, 1e-3, -1e-3, 0.05}) {
                EXPECT_LT(largest_step_past(middle, side, beside), 0.2)
                    << middle.transpose() << ", " << side.transpose() << ", " << beside;
            }
        }
    }
}

// An arm with five joints reaches over its back in the plane y = 0.
TEST(ToolRoll, DoesNotJumpInTheUprightPlaneWhereTheToolPointsBack) {
    EXPECT_LT(largest_step_past(-Vec3::UnitX(), Vec3::UnitZ(), 0.0), 0.01);
}

} // namespace

} // namespace millwright::kinematics
