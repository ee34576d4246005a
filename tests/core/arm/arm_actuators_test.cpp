#include "core/arm/arm_actuators.h"

#include "core/base/error.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

ArmActuators shipped() {
    return *read_arm("assets/arms/motoman-l3.json").actuators;
}

TEST(ArmActuatorsK6, ReturnToTheirCounts) {
    const ArmActuators drives = shipped();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> length(320.0, 760.0), counts(-20'000.0, 20'000.0);
    for (int n = 0; n < 2000; ++n) {
        DrivePositions a;
        a << counts(random), (length(random) - 350.0) / 0.01, (length(random) - 350.0) / 0.01, counts(random),
            counts(random);
        const DrivePositions back = drives_of(drives, joints_of(drives, a));
        EXPECT_LT((back - a).cwiseAbs().maxCoeff(), 1e-7) << a.transpose(); // 1e-9 mm of 0.01 mm a count
    }
}

TEST(ArmActuatorsK6, KeepLinksInTheirDirectionWhenOthersMove) {
    const ArmActuators drives = shipped();
    DrivePositions a = drives_of(drives, test::degrees({0, -90, 90, 20, 0}));
    const JointPositions before = joints_of(drives, a);
    a[1] += 2000.0; // the upper arm alone
    const JointPositions after = joints_of(drives, a);
    EXPECT_GT(std::abs(after[1] - before[1]), 0.01);
    EXPECT_NEAR(after[1] + after[2], before[1] + before[2], 1e-12);                        // link 3
    EXPECT_NEAR(after[1] + after[2] + after[3], before[1] + before[2] + before[3], 1e-12); // link 4
}

TEST(ArmActuatorsK6, RefuseATriangleThatDoesNotClose) {
    const ArmActuators drives = shipped();
    DrivePositions a = drives_of(drives, test::degrees({0, -90, 90, 20, 0}));
    a[2] = 1e6;
    try {
        (void)joints_of(drives, a);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("drive 3 would be 10350.000 mm long"), std::string::npos)
            << error.what();
    }
}

std::vector<double> rolls(double fourth, double fifth) {
    DrivePositions a;
    a << 0.0, 0.0, 0.0, fourth, fifth;
    std::vector<double> found = roll_choices(shipped(), a);
    std::ranges::sort(found);
    return found;
}

TEST(ArmActuatorsK6, ChooseTheTurnOfTheRoll) {
    EXPECT_EQ(rolls(5000.0, 27'200.0), (std::vector{27'200.0, 52'800.0}));
    EXPECT_EQ(rolls(2600.0, 27'200.0), (std::vector{52'800.0}));
    const auto most = [](double fourth) { // of whole counts
        std::size_t found = 0;
        for (int fifth = 0; fifth < 25'600; ++fifth) {
            found = std::max(found, rolls(fourth, fifth).size());
        }
        return found;
    };
    EXPECT_EQ(most(2600.0), 1U);
    EXPECT_EQ(most(2601.0), 1U);
    EXPECT_EQ(most(2602.0), 2U);
}

} // namespace
} // namespace millwright::arm
