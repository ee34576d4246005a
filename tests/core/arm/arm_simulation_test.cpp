#include "core/arm/arm_simulation.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_motion_file.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/arms.h"
#include "tests/support/reason.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace millwright::arm {
namespace {

using test::reason;
using ::testing::HasSubstr;

/// The command file of both printed runs.
constexpr std::string_view printed_file = "G1 X300 Y0 Z0 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;\n";

std::vector<ArmRecord> simulated(std::string_view text, double step) {
    return simulate_arm(test::arm("motoman-l3"), parse_arm_motion(text, "a.mot"), arm_home(), step, "a.mot");
}

TEST(ArmMotionFileS1, ReadsWordsOfEitherCaseInAnyOrder) {
    const auto blocks = parse_arm_motion(
        "\xEF\xBB\xBFg1x10 y-2.5;Z+3 F20\n;; G3 X5 I2.5 A0 B0 C-2 S100 M3;\nG1 X1;", "a.mot");
    ASSERT_EQ(blocks.size(), 4U);
    EXPECT_EQ(blocks[0].way, Vec3(10.0, -2.5, 0.0));
    EXPECT_EQ(blocks[1].way, Vec3(0.0, 0.0, 3.0));
    EXPECT_EQ(blocks[1].feed, 20.0);
    EXPECT_EQ(blocks[2].motion, ArmMotion::counter_clockwise);
    EXPECT_EQ(blocks[2].center, Vec3(2.5, 0.0, 0.0));
    EXPECT_EQ(blocks[2].tool_axis, Vec3(0.0, 0.0, -1.0));
    EXPECT_EQ(blocks[2].line, 2);
}

TEST(ArmMotionFileS1, SaysWhereItIsWrong) {
    const auto why = [](std::string_view text) {
        return reason([&] { (void)parse_arm_motion(text, "a.mot"); });
    };
    EXPECT_THAT(why("X1 ;\nY2 Q3 ;"), HasSubstr("a.mot:2:4: 'Q' is not a word"));
    EXPECT_THAT(why("X ;"), HasSubstr("a.mot:1:3: X needs a number"));
    EXPECT_THAT(why("X1 X2 ;"), HasSubstr("a.mot:1:4: X occurs twice"));
    EXPECT_THAT(why("X1"), HasSubstr("the ';' after the last block is missing"));
    EXPECT_THAT(why("G4 X1 ;"), HasSubstr("a.mot:1:1: G needs a whole number from 1 to 3"));
    EXPECT_THAT(why("G2 X1 ;"), HasSubstr("either its centre (I J K) or its radius (R)"));
    EXPECT_THAT(why("A0 B0 C0 ;"), HasSubstr("no direction"));
    EXPECT_THAT(why("X1e300 ;"), HasSubstr("X needs a number"));
    EXPECT_THAT(why(std::string("X1\x01;", 4)), HasSubstr("byte 1 is not text"));
}

TEST(ArmSimulation, S2HasThePointsOfThePrintedRuns) {
    EXPECT_EQ(simulated(printed_file, 10.0).size(), 75U);
    EXPECT_EQ(simulated(printed_file, 50.0).size(), 18U);
    EXPECT_EQ(simulated("G1 X300;G1 Z-100;G1 X-300 Z100;", 10.0).size(),
              75U); // with or without a last newline
    std::ifstream golden("tests/golden/arm/path-10.txt");
    std::string line;
    const auto records = simulated(printed_file, 10.0);
    std::size_t n = 0;
    while (std::getline(golden, line)) {
        if (line[0] == '#') {
            continue;
        }
        const std::string begin = fmt::format("{:.5f} {:.5f} ", records[n].tip.x(), records[n].tip.z());
        EXPECT_EQ(line.substr(0, begin.size()), begin);
        ++n;
    }
    EXPECT_EQ(n, 75U);
}

TEST(ArmSimulation, S2EveryRecordIsWhereItSays) {
    const ArmModel arm = test::arm("motoman-l3");
    for (const ArmRecord& record : simulated("G1 X100 Y200 Z-50 ; G3 X-80 Y80 I-80 ; G1 Z30 A1 C1 ;", 5.0)) {
        EXPECT_LT((base_T_tool(arm, record.joints).translation() - record.tip).norm(), 1e-9);
    }
}

TEST(ArmSimulation, S4GoesAroundArcs) {
    struct Arc {
        const char* text;
        Vec3 end;    ///< from the start
        Vec3 middle; ///< of the arc, from the start
    };
    const double q = 50.0 * std::sqrt(0.5);
    for (const Arc& arc : {Arc{"G3 X-50 Y50 I-50;", {-50, 50, 0}, {q - 50, q, 0}},
                           Arc{"G3 X-50 Y-50 J-50;", {-50, -50, 0}, {-q, q - 50, 0}},
                           Arc{"G3 X50 Y-50 I50;", {50, -50, 0}, {50 - q, -q, 0}},
                           Arc{"G3 X50 Y50 J50;", {50, 50, 0}, {q, 50 - q, 0}},
                           Arc{"G2 X-50 Y50 J50;", {-50, 50, 0}, {-q, 50 - q, 0}},
                           Arc{"G2 X50 Y50 I50;", {50, 50, 0}, {50 - q, q, 0}},
                           Arc{"G2 X-50 Y50 I-50;", {-50, 50, 0}, {-50 - q, -q, 0}}, // three quarters
                           Arc{"G3 X-50 Y50 R50;", {-50, 50, 0}, {q - 50, q, 0}},
                           Arc{"G3 X-50 Y50 R-50;", {-50, 50, 0}, {q, 50 + q, 0}},
                           Arc{"G3 I-50;", {0, 0, 0}, {-100, 0, 0}}, // a full circle
                           Arc{"G3 X-50 Z50 I-50;", {-50, 0, 50}, {-50 - q, 0, -q}}}) {
        const auto records = simulated(arc.text, 0.5);
        const Vec3 start = records.front().tip;
        EXPECT_LT((records.back().tip - start - arc.end).norm(), 1e-3) << arc.text;
        const Vec3 middle = records[records.size() / 2].tip - start;
        EXPECT_LT((middle - arc.middle).norm(), 1.0) << arc.text << " " << middle.transpose();
    }
}

TEST(ArmSimulation, RefusesWhatTheArmCannotDo) {
    const auto why = [](std::string_view text) { return reason([&] { (void)simulated(text, 10.0); }); };
    EXPECT_THAT(why("X100 ;\nX2000 ;"), HasSubstr("a.mot:2: the arm cannot reach"));
    EXPECT_THAT(why("G2 X50 I10 ;"), HasSubstr("a.mot:1: the end is 40.0000 mm from the centre"));
    EXPECT_THAT(why("G2 X50 R10 ;"), HasSubstr("less than half the distance"));
    for (const char* off_the_plane : {"G2 K50 ;", "G2 I10 K50 ;", "G3 Z100 K50 ;", "G2 X10 Z100 I5 K50 ;"}) {
        EXPECT_THAT(why(off_the_plane), HasSubstr("a.mot:1: start, end and centre lie on a line that leaves"))
            << off_the_plane;
    }
    EXPECT_THAT(why("X1 A0 B1 ;"), HasSubstr("90.000 deg out of the plane of the arm"));
}

TEST(ArmResultS3, HasTheLayoutOfTheThesis) {
    JointPositions printed = test::degrees({0.0, -84.09386, 90.0, -5.90614, 0.0});
    EXPECT_EQ(arm_result_text(test::arm("motoman-l3"), {{Vec3(800.0, 0.0, 650.0), printed, 0}}),
              "next position 800.00000 0.00000 650.00000 \n\n 1 := 0.00000 \n 2 := -84.09386 \n"
              " 3 := 90.00000 \n 4 := -5.90614 \n 5 := 0.00000 \n");
}

TEST(ArmResultS3, ReadsBackWhatItWrote) {
    const auto records = simulated(printed_file, 10.0);
    const ArmModel l3 = test::arm("motoman-l3");
    const std::string text = arm_result_text(l3, records);
    const auto back = parse_arm_result(l3, text, "a.res");
    ASSERT_EQ(back.size(), records.size());
    EXPECT_EQ(arm_result_text(l3, back), text);
    EXPECT_THAT(reason([&] { (void)parse_arm_result(l3, text.substr(0, 200), "a.res"); }),
                HasSubstr("a.res:"));
    EXPECT_THAT(reason([&] { (void)parse_arm_result(l3, "nonsense\n", "a.res"); }),
                HasSubstr("a.res:1: 'next position '"));
}

TEST(ArmMotionWays, TurnTheToolEvenlyAlongTheirBlock) {
    const ArmModel arm = test::arm("motoman-l3");
    const auto ways =
        ways_of(arm, parse_arm_motion("X100 F20;\nX-50 A1 B0 C0;\nZ-10;", "a.mot"), arm_home(), "a.mot");
    ASSERT_EQ(ways.size(), 3U);
    EXPECT_NEAR(ways[0].duration, 5.0, 1e-12);
    EXPECT_NEAR(ways[1].duration, 2.5, 1e-12);
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        const Frame tool = ways[1].at(share);
        const double angle = 0.5 * pi * share; // from up to x
        EXPECT_LE((tool.linear().col(2) - Vec3(std::sin(angle), 0.0, std::cos(angle))).norm(), 1e-9);
        EXPECT_LE((tool.translation() - Vec3(900.0 - 50.0 * share, 0.0, 650.0)).norm(), 1e-9);
    }
    EXPECT_LE((ways[2].at(0.5).linear().col(2) - Vec3::UnitX()).norm(), 1e-9);
    EXPECT_LE((ways[2].at(1.0).translation() - Vec3(850.0, 0.0, 640.0)).norm(), 1e-9);
}

TEST(ArmMotionWays, AreFollowedByTheArmOfTheThesis) {
    const ArmModel arm = test::arm("motoman-l3");
    const auto ways = ways_of(arm, parse_arm_motion(printed_file, "a.mot"), arm_home(), "a.mot");
    ArmPathSettings settings;
    settings.aim.demand = ArmDemand::tip;
    const ArmPath path = follow_path(arm, ways, arm_home(), settings, {});
    ASSERT_TRUE(path.whole()) << path.findings.front().why;
    EXPECT_LE((base_T_tool(arm, path.points.back().joints).translation() - Vec3(800.0, 0.0, 650.0)).norm(),
              1e-6);
}

TEST(ArmMotionWays, NeedAFeedAboveNothing) {
    const ArmModel arm = test::arm("motoman-l3");
    EXPECT_THAT(
        reason([&] { (void)ways_of(arm, parse_arm_motion("X1;\nX1 F0;", "a.mot"), arm_home(), "a.mot"); }),
        HasSubstr("a.mot:2: the feed F must be above 0"));
}

/// Every point, in turn: the stretch that an arm cannot go has a beginning, an end and a size.
TEST(ArmSimulation, NamesTheStretchThatIsOutOfReach) {
    // From 800 0 650 straight out: sqrt(1450^2 - 650^2) = 1296.15 from the base's axis is the end.
    const std::string why = reason([&] { (void)simulated("X100 ;\nX1000 ;\nX-1100 ;", 10.0); });
    EXPECT_THAT(why,
                HasSubstr("a.mot:2: the arm cannot reach 1300.000 0.000 650.000, point 52 of the path, "
                          "500.000 mm along it: the wrist would be 1453.444 mm from the shoulder"));
    EXPECT_THAT(why, HasSubstr("up to point 173, 1300.000 0.000 650.000, line 3"));
    EXPECT_THAT(why, HasSubstr("the worst, at point 112, 558.109 mm off"));
}

class ArmSimulationOfAnyArm : public ::testing::TestWithParam<std::pair<const char*, JointPositions>> {};

TEST_P(ArmSimulationOfAnyArm, ComesToEveryPointOfTheFile) {
    const auto& [name, start] = GetParam();
    const ArmModel arm = test::arm(name);
    const Frame first = base_T_tool(arm, start);
    const auto blocks = parse_arm_motion("X-30 ;\nY40 Z-20 ;\nG2 X30 I15 J0 ;\nG1 Y-40 Z20 ;", "a.mot");
    const auto records = simulate_arm(arm, blocks, start, 5.0, "a.mot");
    ASSERT_GT(records.size(), 30U);
    for (const ArmRecord& record : records) {
        const Frame tool = base_T_tool(arm, record.joints);
        EXPECT_LT((tool.translation() - record.tip).norm(), 1e-8);
        EXPECT_LT(angle_between(tool.linear().col(2), first.linear().col(2)), 1e-9);
        EXPECT_LT(arm.joint_outside(record.joints), 0);
    }
    EXPECT_LT((records.back().tip - first.translation()).norm(), 1e-3); // of single precision
    const auto back = parse_arm_result(arm, arm_result_text(arm, records), "a.res");
    EXPECT_LT((back.back().joints - records.back().joints).cwiseAbs().maxCoeff(), 1e-5);
}

JointPositions quill_down() {
    JointPositions start = test::degrees({20.0, 60.0, 0.0, 0.0});
    start[2] = 80.0; // mm
    return start;
}

INSTANTIATE_TEST_SUITE_P(Arms,
                         ArmSimulationOfAnyArm,
                         ::testing::Values(std::pair("scara", quill_down()),
                                           std::pair("six-axis",
                                                     test::degrees({10.0, 20.0, -20.0, 15.0, 70.0, 0.0}))));

TEST(ArmSimulationOfAnyArm, TellsACardOfThreeAxesFromAnArmThatSlides) {
    const ArmModel scara = test::arm("scara");
    EXPECT_THAT(reason([&] {
                    (void)first_turns_deg(scara, {{Vec3::Zero(), quill_down(), 0}});
                }),
                HasSubstr("joint 3 of SCARA does not turn"));
}

} // namespace
} // namespace millwright::arm
