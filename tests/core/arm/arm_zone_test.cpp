#include "core/arm/arm_zone.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_hold.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/arms.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

using test::degrees;
using testing::HasSubstr;
using testing::IsEmpty;

ArmModel with(ArmZone zone) {
    ArmDescription description = test::arm("motoman-l3").description();
    description.zone = std::make_shared<const ArmZone>(std::move(zone));
    return ArmModel(std::move(description));
}

ArmActuators drives() {
    return *read_arm("assets/arms/motoman-l3.json").actuators;
}

TEST(ArmZone, TheBoxHoldsTheTip) {
    ArmZone box;
    box.least = {-500.0, -500.0, -300.0};
    const ArmModel arm = with(box);
    EXPECT_THAT(zone_breaches(arm, degrees({0.0, 0.0, 0.0, 0.0, 0.0})), IsEmpty());
    const auto down = degrees({180.0, 90.0, 0.0, 0.0, 0.0}); // hangs at z = -1450
    const auto found = zone_breaches(arm, down);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].depth, 1150.0, 1e-9);
    EXPECT_THAT(found[0].why, HasSubstr("Z -1450.0 mm, below -300"));
    EXPECT_EQ(zone_breaches(arm, degrees({90.0, 0.0, 0.0, 0.0, 0.0})).size(), 0U);
    EXPECT_EQ(zone_breaches(arm, degrees({-90.0, 0.0, 0.0, 0.0, 0.0})).size(), 1U);
}

/// Whoever stands outside may come back, and go no farther out.
TEST(ArmZone, ItMayBeEnteredFromOutside) {
    ArmZone box;
    box.least.z() = -300.0;
    const ArmModel arm = with(box);
    const auto far = degrees({0.0, 60.0, 0.0, 0.0, 0.0}), less = degrees({0.0, 50.0, 0.0, 0.0, 0.0});
    EXPECT_EQ(leaves_zone(arm, far, less), "");
    EXPECT_THAT(leaves_zone(arm, less, far), HasSubstr("below -300"));
    EXPECT_EQ(leaves_zone(arm, less, far, 2000.0), "");
}

/// A drive's place gives the joints; joints from any place inside the limits are inside, a count beyond is
/// not.
TEST(ArmZone, TheDrivesLimitsAreThoseOfTheThesis) {
    ArmZone zone;
    zone.drives = drives();
    const ArmModel arm = with(zone);
    const auto breaches_at = [&](double second, double third, double fourth, double fifth) {
        DrivePositions counts;
        counts << 0.0, second, third, fourth, fifth;
        return zone_breaches(arm, joints_of(*zone.drives, counts));
    };
    EXPECT_THAT(breaches_at(20000.0, 15000.0, 3000.0, 40000.0), IsEmpty());
    EXPECT_THAT(breaches_at(20000.0, 22990.0, 3000.0, 40000.0), IsEmpty());
    EXPECT_EQ(breaches_at(20000.0, 23010.0, 3000.0, 40000.0).size(), 1U); // A3 < A2 + 3000
    EXPECT_THAT(breaches_at(20000.0, 10010.0, 3000.0, 40000.0), IsEmpty());
    EXPECT_EQ(breaches_at(20000.0, 9990.0, 3000.0, 40000.0).size(), 1U); // A3 > A2 - 10000
    EXPECT_THAT(breaches_at(20000.0, 15000.0, 2000.0, 30100.0), IsEmpty());
    // 32000 - A4 < A5 < 55000 is narrower than a turn of 25600 where A4 is below 2600.
    EXPECT_EQ(breaches_at(20000.0, 15000.0, 2000.0, 29900.0).size(), 1U);
    EXPECT_THAT(breaches_at(20000.0, 15000.0, 2700.0, 29250.0), IsEmpty()); // as 54850
}

TEST(ArmZone, ATriangleOpensByHalfATurnAtMost) {
    ArmZone zone;
    zone.drives = drives();
    zone.drives->limits = {};
    const ArmModel arm = with(zone);
    EXPECT_THAT(zone_breaches(arm, degrees({0.0, -60.0, 60.0, 0.0, 0.0})), IsEmpty());
    const auto found = zone_breaches(arm, degrees({0.0, 30.0, -30.0, 0.0, 0.0}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].why, HasSubstr("drive 2"));
    EXPECT_EQ(zone_breaches(arm, degrees({0.0, -60.0, 180.0, 0.0, 0.0})).size(), 1U);
}

TEST(ArmZone, AHoldOutsideIsRefusedWithItsReason) {
    ArmZone box;
    box.least.z() = 0.0;
    const ArmModel arm = with(box);
    const JointPositions from = degrees({0.0, -60.0, 60.0, 0.0, 0.0});
    Frame goal = base_T_tool(arm, from);
    const ArmAim aim{ArmDemand::tip, 1.0};
    EXPECT_EQ(hold_tool(arm, goal, aim, from).trouble, ArmTrouble::none);
    goal.translation().z() = -100.0;
    const ArmHold below = hold_tool(arm, goal, aim, from);
    EXPECT_EQ(below.trouble, ArmTrouble::joint_limit);
    EXPECT_THAT(below.why, HasSubstr("below 0 of the arm's workspace"));
    EXPECT_THAT(all_holds(arm, goal, aim, from), IsEmpty());
    EXPECT_EQ(below.joints, from);
}

TEST(ArmZone, TheFileSaysWhatIsKept) {
    const test::ScratchFolder scratch;
    std::string text = read_file("assets/arms/motoman-l3.json");
    text.erase(text.rfind("\"bodies\"")); // the glb is elsewhere
    text.erase(text.rfind(','));
    text += "}";
    const auto read = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        const auto at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        write_file(scratch / "arm.json", changed);
        return read_arm(scratch / "arm.json");
    };
    const ArmFile shipped = read("\"watched\": false", "\"watched\": false");
    ASSERT_NE(shipped.arm.zone(), nullptr);
    EXPECT_EQ(shipped.arm.zone()->least.z(), -900.0);
    EXPECT_FALSE(shipped.arm.zone()->drives);
    EXPECT_TRUE(read("\"watched\": false", "\"watched\": true").arm.zone()->drives);
    EXPECT_TRUE(read(",\n            \"watched\": false", "").arm.zone()->drives);
    EXPECT_THROW((void)read("[-900, 1500]", "[1500, -900]"), Error);
    EXPECT_THROW((void)read("\"watched\": false", "\"watched\": 1"), Error);
}

} // namespace
} // namespace millwright::arm
