#include "core/kinematics/arm_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::kinematics {
namespace {

using ::testing::HasSubstr;

class ArmFileTest : public ::testing::Test {
protected:
    std::string text_ = read_file("assets/arms/motoman-l3.json");
    test::ScratchFolder scratch_;

    std::string reason(const std::string& what, const std::string& by) {
        std::string text = text_;
        const auto at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        text.replace(at, what.size(), by);
        write_file(scratch_ / "arm.json", text);
        try {
            (void)read_arm(scratch_ / "arm.json");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return "none";
    }
};

TEST_F(ArmFileTest, ReadsWhatShips) {
    const ArmFile l3 = read_arm("assets/arms/motoman-l3.json");
    ASSERT_TRUE(l3.arm.planar_elbow());
    EXPECT_DOUBLE_EQ(l3.arm.planar_elbow()->upper_arm, 650.0);
    EXPECT_TRUE(l3.actuators);
    EXPECT_EQ(read_arm("assets/arms/six-axis.json").arm.joint_count(), 6);
    EXPECT_EQ(read_arm("assets/arms/scara.json").arm.joint(2).kind, JointKind::prismatic);
}

TEST_F(ArmFileTest, SaysWhereAWrongFileIsWrong) {
    EXPECT_EQ(reason("Yaskawa", "Y"), "none");
    EXPECT_THAT(reason("\"a\": 650", "\"a\": \"long\""), HasSubstr("arm.json:"));
    EXPECT_THAT(reason("\"a\": 650", "\"b\": 650"), HasSubstr("arm.json:"));
    EXPECT_THAT(reason("[-200, 60]", "[60, -200]"), HasSubstr("lower limit is not below"));
    EXPECT_THAT(reason("[-10000, 3000]", "[3000, -10000]"), HasSubstr("lower limit is not below"));
    EXPECT_THAT(reason("millwright-arm", "something"), HasSubstr("not an arm file"));
    EXPECT_THAT(reason("\"name\": \"2\"", "\"name\": \"1\""), HasSubstr("another joint is called so"));
    EXPECT_THAT(reason("revolute", "round"), HasSubstr("neither \"revolute\" nor \"prismatic\""));
    EXPECT_THAT(reason("\"beta\": 250", "\"beta\": -1"), HasSubstr("sides longer than 0"));
    EXPECT_THAT(reason("\"scale\": 0.01", "\"scale\": 0"), HasSubstr("drive 2 needs a finite scale"));
    EXPECT_THAT(reason("\"a\": 800, \"d\": 0", "\"a\": 800, \"d\": 10"), HasSubstr("three parallel joints"));
}

} // namespace
} // namespace millwright::kinematics
