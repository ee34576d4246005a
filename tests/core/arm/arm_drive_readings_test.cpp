// Drives against joints and their limits: the formulas of Saengsasri, Nittayachin 1996, KMITL, sections 1.2
// and 1.5, written out apart from this program, corrected and as printed.
#include "core/arm/arm_drive_readings.h"

#include "core/base/error.h"
#include "tests/support/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::arm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ArmActuators shipped_drives() {
    return *read_arm("assets/arms/motoman-l3.json").actuators;
}

/// One of the linear drives: its length at the angle of its triangle.
double length_by_cosines(const Linkage& linkage, double angle) {
    const double alpha = std::hypot(linkage.gamma, linkage.phi);
    return std::sqrt(-2.0 * alpha * linkage.beta * std::cos(angle) + alpha * alpha +
                     linkage.beta * linkage.beta);
}

/// Section 1.5, corrected.
DrivePositions drives_by_formulas(const ArmActuators& d, const JointPositions& q) {
    const auto& s = d.scales;
    const double second = q[1] - d.second.omega - std::atan(d.second.phi / d.second.gamma) + 1.5 * pi;
    const double third = q[1] + q[2] - std::atan(d.third.phi / d.third.gamma) + 0.5 * pi;
    DrivePositions a;
    a << (q[0] - s[0].offset) / s[0].scale, (length_by_cosines(d.second, second) - s[1].offset) / s[1].scale,
        (length_by_cosines(d.third, third) - s[2].offset) / s[2].scale,
        (pi + s[3].offset - q[1] - q[2] - q[3]) / s[3].scale, (s[4].offset - q[4]) / s[4].scale;
    return a;
}

TEST(ArmDriveReadingsK6, AreThoseOfTheCorrectedFormulas) {
    ArmActuators drives = shipped_drives();
    drives.scales[0].offset = 0.02; // so that no offset hides by being 0
    drives.scales[3].offset = 0.3;
    std::mt19937 random(6);
    std::uniform_real_distribution<double> second(-3.0, 0.0), third(-0.9, 0.9), any(-1.5, 1.5);
    for (int n = 0; n < 1000; ++n) {
        JointPositions q(5);
        q[0] = any(random);
        q[1] = second(random);
        q[2] = third(random) - q[1]; // of link 3 against the base
        q[3] = any(random);
        q[4] = any(random);
        const DrivePositions a = drives_by_formulas(drives, q);
        const ArmDriveReadings found = drive_readings(drives, q);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(found.drives[k].counts, a[static_cast<Eigen::Index>(k)], 1e-6);
        }
        EXPECT_NEAR(std::remainder(found.drives[4].counts - a[4], 25'600.0), 0.0, 1e-6);
        EXPECT_NEAR(*found.drives[1].length, drives.scales[1].scale * a[1] + drives.scales[1].offset, 1e-9);
        EXPECT_LT((drive_readings(drives, a).joints - q).cwiseAbs().maxCoeff(), 1e-9);
    }
}

/// What the thesis prints in its forward and inverse formulas cannot both be meant: going there and back ends
/// elsewhere.
TEST(ArmDriveReadingsK6, DoNotComeBackByTheFormulasAsPrinted) {
    ArmActuators drives = shipped_drives();
    drives.scales[3].offset = 0.3;
    const JointPositions q = test::degrees({10, -80, 90, 20, 30});
    const auto& s = drives.scales;
    const DrivePositions right = drives_by_formulas(drives, q);
    DrivePositions printed = right;
    printed[3] = (pi - s[3].offset - q[1] - q[2] - q[3]) / s[3].scale; // A4 with - lambda 4
    printed[4] = (s[4].offset - q[1]) / s[4].scale;                    // A5 with theta 2
    const JointPositions back = joints_of(drives, printed);
    EXPECT_NEAR(back[3] - q[3], 2.0 * s[3].offset, 1e-9);
    EXPECT_NEAR(back[4], q[1], 1e-9);
    // The law of cosines with alpha 2 beta 2 alone has no angle there.
    const double alpha = drives.second.alpha(), beta = drives.second.beta;
    const double length = s[1].scale * right[1] + s[1].offset;
    const double square = length * length - alpha * alpha - beta * beta;
    const double angle = std::acos(square / (-2.0 * alpha * beta));
    EXPECT_NEAR(angle, triangle_angles(drives, q)[0], 1e-9);
    EXPECT_GT(std::abs(std::acos(std::clamp(square / (alpha * beta), -1.0, 1.0)) - angle), 0.1);
}

/// "A2 - 10000 > A3 > A2 + 3000" holds nowhere; with its first sign turned it is a range of 13000 counts.
TEST(ArmDriveReadingsK6, BindTheThirdDriveToTheSecond) {
    const ArmActuators drives = shipped_drives();
    const auto with_third = [&](double third) {
        DrivePositions a;
        a << 0.0, 10'000.0, third, 12'800.0, 41'000.0;
        ArmDriveReadings found = drive_readings(drives, a);
        EXPECT_DOUBLE_EQ(found.drives[2].low, 0.0);
        EXPECT_DOUBLE_EQ(found.drives[2].high, 13'000.0);
        EXPECT_EQ(found.drives[1].inside, found.drives[2].inside); // each by the other
        return found;
    };
    for (const double third : {1.0, 12'999.0}) {
        EXPECT_TRUE(with_third(third).drives[2].inside);
        EXPECT_THAT(with_third(third).reasons, IsEmpty());
    }
    EXPECT_FALSE(with_third(0.0).drives[2].inside);
    EXPECT_FALSE(with_third(13'000.0).drives[2].inside);
    for (const double third : {-1.0, 13'001.0}) {
        EXPECT_FALSE(with_third(third).drives[2].inside);
        EXPECT_THAT(with_third(third).reasons, ElementsAre(HasSubstr("drive 3 would be")));
    }
}

TEST(ArmDriveReadingsK6, ChooseTheTurnOfTheFifthInItsWindow) {
    const ArmActuators drives = shipped_drives();
    DrivePositions a = drives_of(drives, test::degrees({0, -90, 90, 0, 0}));
    EXPECT_NEAR(a[3], 12'800.0, 1e-6);
    a[4] = 27'200.0; // 32000 - A4 is 19200
    const ArmDriveReadings found = drive_readings(drives, a);
    EXPECT_NEAR(found.drives[4].low, 19'200.0, 1e-6);
    EXPECT_DOUBLE_EQ(found.drives[4].high, 55'000.0);
    EXPECT_THAT(found.roll_choices, ElementsAre(27'200.0, 52'800.0));
    EXPECT_TRUE(found.drives[4].inside);
    a[4] = 27'200.0 + 2.0 * 25'600.0;
    const ArmDriveReadings beyond = drive_readings(drives, a);
    EXPECT_FALSE(beyond.drives[4].inside);
    EXPECT_THAT(beyond.reasons, ElementsAre(HasSubstr("one turn further it would be inside, at 52800")));
    // From the joint's own angle the turn inside is taken.
    const JointPositions twice = test::degrees({0, -90, 90, 0, -300});
    EXPECT_GT(drives_of(drives, twice)[4], 55'000.0);
    const ArmDriveReadings chosen = drive_readings(drives, twice);
    EXPECT_TRUE(chosen.drives[4].inside);
    EXPECT_NEAR(chosen.drives[4].counts, drives_of(drives, twice)[4] - 25'600.0, 1e-6);
}

TEST(ArmDriveReadingsK6, SayWhereATriangleIsFlat) {
    const ArmActuators drives = shipped_drives();
    const double alpha = std::hypot(500.0, 200.0);
    ArmDriveReadings found = drive_readings(drives, test::degrees({0, -90, 90, 0, 0}));
    EXPECT_THAT(found.reasons, testing::Each(testing::Not(HasSubstr("triangle"))));
    EXPECT_GE(found.drives[1].low, (alpha - 250.0 - 350.0) / 0.01 - 1e-6);
    EXPECT_LE(found.drives[1].high, (alpha + 250.0 - 350.0) / 0.01 + 1e-6);
    found = drive_readings(drives, test::degrees({0, 20, 60, 0, 0}));
    EXPECT_FALSE(found.drives[1].inside);
    EXPECT_THAT(found.reasons, testing::Contains(HasSubstr("drive 2 would have to open its triangle")));
    DrivePositions a = DrivePositions::Zero();
    a[1] = 1e6;
    EXPECT_THROW((void)drive_readings(drives, a), Error);
}

// They were shown without limits. 180 degrees are 21600 counts of drive 1 and 12800 of drive 4.
TEST(ArmDriveReadings, TheLimitsOfTheJointsOneAndFourAreThoseOfTheirDrives) {
    const ArmFile file = read_arm("assets/arms/motoman-l3.json");
    const ArmActuators& drives = *file.actuators;
    ArmDriveReadings found = drive_readings(drives, test::degrees({0, -90, 90, 0, 0}));
    add_joint_limits(found, drives, file.arm);
    EXPECT_NEAR(found.drives[0].low, -175.0 / 180.0 * 21'600.0, 1e-3);
    EXPECT_NEAR(found.drives[0].high, 175.0 / 180.0 * 21'600.0, 1e-3);
    EXPECT_NEAR(found.drives[3].low, found.drives[3].counts - 270.0 / 180.0 * 12'800.0, 1e-3);
    EXPECT_NEAR(found.drives[3].high, found.drives[3].counts + 270.0 / 180.0 * 12'800.0, 1e-3);
    EXPECT_TRUE(found.drives[0].inside);
    for (const auto& [joint, edge] : {std::pair(0, 175.0), std::pair(3, 270.0)}) {
        for (const double sign : {-1.0, 1.0}) {
            JointPositions q = test::degrees({0, -90, 90, 0, 0});
            q[joint] = test::degrees({sign * edge})[0];
            ArmDriveReadings at = drive_readings(drives, q);
            add_joint_limits(at, drives, file.arm);
            EXPECT_TRUE(at.drives[static_cast<std::size_t>(joint)].inside) << joint;
            q[joint] = test::degrees({sign * (edge + 0.1)})[0];
            ArmDriveReadings beyond = drive_readings(drives, q);
            add_joint_limits(beyond, drives, file.arm);
            EXPECT_FALSE(beyond.drives[static_cast<std::size_t>(joint)].inside) << joint;
        }
    }
}

} // namespace
} // namespace millwright::arm
