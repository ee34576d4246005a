#include "core/arm/arm_file.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/support/arms.h"
#include "tests/support/reason.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::arm {
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
    EXPECT_THAT(reason("[-200, 60]", "[60, -200]"), HasSubstr("lower limit must be below"));
    EXPECT_THAT(reason("[-10000, 3000]", "[3000, -10000]"), HasSubstr("lower limit must be below"));
    EXPECT_THAT(reason("millwright-arm", "something"), HasSubstr("not an arm file"));
    EXPECT_THAT(reason("\"name\": \"2\"", "\"name\": \"1\""), HasSubstr("another joint has the same name"));
    EXPECT_THAT(reason("revolute", "round"), HasSubstr("not \"revolute\" or \"prismatic\""));
    EXPECT_THAT(reason("\"beta\": 250", "\"beta\": -1"), HasSubstr("sides longer than 0"));
    EXPECT_THAT(reason("\"scale\": 0.01", "\"scale\": 0"), HasSubstr("drive 2 needs a finite scale"));
    EXPECT_THAT(reason("\"a\": 800, \"d\": 0", "\"a\": 800, \"d\": 10"), HasSubstr("three parallel joints"));
}

/// The table of a six-axis arm with a spherical wrist, as catalogues print it: the last link has a twist,
/// too.
const std::string classical_table =
    R"({"format": "millwright-arm", "version": 1, "name": "Table", "source": "ours",
 "convention": "classical",
 "joints": [
  {"name": "1", "kind": "revolute", "alpha": 90, "a": 20, "d": 89.2, "theta": 0, "limits": [-180, 180], "max_velocity": 180, "max_acceleration": 600},
  {"name": "2", "kind": "revolute", "alpha": 0, "a": -425, "d": 0, "theta": 10, "limits": [-180, 180], "max_velocity": 180, "max_acceleration": 600},
  {"name": "3", "kind": "prismatic", "alpha": -35, "a": 12, "d": 30, "theta": 25, "limits": [-100, 200], "max_velocity": 180, "max_acceleration": 600},
  {"name": "4", "kind": "revolute", "alpha": 70, "a": 15, "d": -8, "theta": -90, "limits": [-180, 180], "max_velocity": 180, "max_acceleration": 600}],
 "tool_tip": [5, -7, 100], "home": [10, -20, 50, 40]})";

/// The link of Denavit and Hartenberg 1955, written out as in Spong, Hutchinson and Vidyasagar, eq. 3.10.
Eigen::Matrix4d classical_link(double theta, double d, double a, double alpha) {
    const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
    Eigen::Matrix4d m;
    m << ct, -st * ca, st * sa, a * ct, st, ct * ca, -ct * sa, a * st, 0, sa, ca, d, 0, 0, 0, 1;
    return m;
}

TEST_F(ArmFileTest, ReadsAClassicalTable) {
    write_file(scratch_ / "table.json", classical_table);
    const ArmModel arm = read_arm(scratch_ / "table.json").arm;
    std::mt19937 random{7};
    for (int n = 0; n < 200; ++n) {
        const JointPositions q = test::random_joints(random, arm);
        Eigen::Matrix4d product = classical_link(q[0], 89.2, 20.0, 0.5 * pi) *
                                  classical_link(q[1] + from_degrees(10.0), 0.0, -425.0, 0.0) *
                                  classical_link(from_degrees(25.0), 30.0 + q[2], 12.0, from_degrees(-35.0)) *
                                  classical_link(q[3] - 0.5 * pi, -8.0, 15.0, from_degrees(70.0));
        product.col(3) = product * Eigen::Vector4d(5.0, -7.0, 100.0, 1.0);
        EXPECT_LT((base_T_tool(arm, q).matrix() - product).cwiseAbs().maxCoeff(), 1e-9);
        // The Jacobian is that of the same chain: by differences of positions.
        constexpr double step = 1e-6;
        JointPositions moved = q;
        moved[3] += step;
        const Vec3 by_difference =
            (base_T_tool(arm, moved).translation() - base_T_tool(arm, q).translation()) / step;
        EXPECT_LT((arm_jacobian(arm, q).col(3).head<3>() - by_difference).norm(), 1e-3);
    }
    JointPositions home = test::degrees({10.0, -20.0, 0.0, 40.0});
    home[2] = 50.0;
    EXPECT_LT((arm.home() - home).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(ArmFileTest, TakesAlphaAndAOfTheLinkBeforeAJointUnlessTheFileSaysOtherwise) {
    std::string text = classical_table;
    const auto without = [&](const std::string& by) {
        std::string changed = text;
        changed.replace(changed.find("\"classical\""), 11, by);
        write_file(scratch_ / "table.json", changed);
        return read_arm(scratch_ / "table.json").arm;
    };
    const ArmModel modified = without("\"modified\"");
    EXPECT_DOUBLE_EQ(modified.joint(0).a, 20.0);
    EXPECT_DOUBLE_EQ(modified.description().end_a, 0.0);
    const ArmModel classical = without("\"classical\"");
    EXPECT_DOUBLE_EQ(classical.joint(0).a, 0.0);
    EXPECT_DOUBLE_EQ(classical.joint(1).a, 20.0);
    EXPECT_DOUBLE_EQ(classical.description().end_a, 15.0);
    EXPECT_THAT(test::reason([&] { (void)without("\"standard\""); }),
                HasSubstr("table.json:2:16: convention: 'standard' is not \"modified\" or \"classical\""));
}

/// Whichever table describes it, the L-3 is solved in closed form.
TEST_F(ArmFileTest, SeesTheL3InItsClassicalTable) {
    const ArmModel l3 = test::arm("motoman-l3");
    ArmDescription table = l3.description();
    constexpr std::array<double, 5> alphas{-90.0, 0.0, 0.0, 90.0, 0.0}, lengths{0.0, 650.0, 800.0, 0.0, 0.0};
    for (std::size_t n = 0; n < alphas.size(); ++n) {
        table.joints[n].alpha = from_degrees(alphas[n]);
        table.joints[n].a = lengths[n];
    }
    const ArmModel arm(from_classical(table));
    EXPECT_TRUE(arm.planar_elbow());
    const JointPositions q = test::degrees({30.0, -60.0, 80.0, 20.0, 45.0});
    EXPECT_LT((base_T_tool(arm, q).matrix() - base_T_tool(l3, q).matrix()).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(ArmFileTest, RefusesAHomeThatIsNone) {
    const auto with_home = [&](const std::string& by) {
        std::string text = classical_table;
        const std::string home = "[10, -20, 50, 40]";
        text.replace(text.find(home), home.size(), by);
        write_file(scratch_ / "table.json", text);
        return test::reason([&] { (void)read_arm(scratch_ / "table.json"); });
    };
    EXPECT_THAT(with_home("[10, -20, 250, 40]"), HasSubstr("outside the limits of joint 3"));
    EXPECT_THAT(with_home("[10, -20, 50]"), HasSubstr("table.json:8:"));
}

} // namespace
} // namespace millwright::arm
