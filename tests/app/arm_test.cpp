#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

nlohmann::json answer_to(const std::vector<std::string>& words) {
    const Ended ended = run(words);
    nlohmann::json answer = nlohmann::json::parse(ended.out);
    const bool nothing_found = answer.contains("reason");
    EXPECT_EQ(ended.exit_code, nothing_found ? 1 : 0) << ended.err;
    return answer;
}

TEST(Arm, TellsWhereTheJointsBringTheTool) {
    const auto answer = answer_to({"arm", "fk", "30", "-60", "80", "20", "45", "--json"});
    EXPECT_NEAR(answer.at("x").get<double>(), 932.496401, 1e-6);
    EXPECT_NEAR(answer.at("y").get<double>(), 538.377048, 1e-6);
    EXPECT_NEAR(answer.at("z").get<double>(), 289.300398, 1e-6);
    EXPECT_NEAR(answer.at("tool").at(0).get<double>(), 0.556670, 1e-6);
}

TEST(Arm, FindsTheJointsThatReachAPoint) {
    const auto answer = answer_to({"arm", "ik", "800", "0", "650", "0", "0", "1", "--json"});
    ASSERT_EQ(answer.at("solutions").size(), 2U); // the limits of joint 2 leave the front
    const std::vector<double> home{0.0, -90.0, 90.0, 0.0, 0.0};
    for (std::size_t n = 0; n < home.size(); ++n) {
        EXPECT_NEAR(answer.at("solutions").at(0).at(n).get<double>(), home[n], 1e-6);
    }
    EXPECT_FALSE(answer.contains("reason"));
    EXPECT_EQ(answer.at("singular"), nlohmann::json({false, false}));
    const auto above =
        answer_to({"arm", "ik", "0", "0", "1000", "0", "0", "1", "--json"}); // on joint 1's axis
    EXPECT_EQ(above.at("singular"), nlohmann::json({true, true}));
    EXPECT_EQ(answer_to({"arm", "ik", "800", "0", "650", "0", "0", "1e300", "--json"}), answer);
}

TEST(Arm, SaysWhyNothingReachesAPoint) {
    const Ended none = run({"arm", "ik", "1500", "0", "0", "0", "0", "1"});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_EQ(none.out, "");
    EXPECT_THAT(none.err, HasSubstr("millwright: no solution: the wrist would be 1500.000 mm"));
    const auto far = answer_to({"arm", "ik", "1500", "0", "0", "0", "0", "1", "--json"});
    EXPECT_TRUE(far.at("solutions").empty());
    EXPECT_THAT(far.at("reason").get<std::string>(), HasSubstr("291.924 to 1450.000"));
    // Nearer than joint 3 can bend, though the links alone would reach it.
    const auto near = answer_to({"arm", "ik", "0", "200", "0", "0", "0", "1", "--json"});
    EXPECT_TRUE(near.at("solutions").empty());
    EXPECT_EQ(
        near.at("reason").get<std::string>(),
        "the wrist would be 200.000 mm from the shoulder, but the arm reaches from 291.924 to 1450.000");
    const std::vector<std::string> leaning{"arm", "ik", "800", "100", "0", "0", "0.6", "0.8", "--json"};
    EXPECT_THAT(answer_to(leaning).at("reason").get<std::string>(), HasSubstr("out of the plane"));
    auto projected = leaning;
    projected.emplace_back("--project");
    EXPECT_FALSE(answer_to(projected).at("solutions").empty());
}

/// Joints, r11 ... r33 and tip, worked out apart from this program from the closed forms of the thesis.
struct WholePose {
    std::vector<double> joints;
    std::vector<double> rotation;
    std::vector<double> tip;
};

const std::vector<WholePose> whole_poses{
    {{0, -90, 90, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {800, 0, 650}},
    {{0, -90, 90, 90, 0}, {0, 0, 1, 0, 1, 0, -1, 0, 0}, {800, 0, 650}},
    {{0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1450, 0, 0}},
    {{30, -60, 80, 20, 45},
     {0.115551, -0.822658, 0.556670, 0.883210, 0.341535, 0.321394, -0.454519, 0.454519, 0.766044},
     {932.496401, 538.377048, 289.300398}},
    {{-45, -100, 120, -30, 10},
     {0.808573, 0.575442, -0.122788, -0.562997, 0.817287, 0.122788, 0.171010, -0.030154, 0.984808},
     {451.758347, -451.758347, 366.508925}},
    {{90, -30, 45, 60, -90},
     {1.0, 0.0, 0.0, 0.0, 0.258819, 0.965926, 0.0, -0.965926, 0.258819},
     {0.0, 1335.657173, 117.944764}},
    {{120, -75, 100, 65, 170},
     {-0.150384, 0.852869, -0.5, -0.086824, 0.492404, 0.866025, 0.984808, 0.173648, 0.0},
     {-446.639304, 773.601968, 289.757178}},
    {{-170, -20, 60, -10, -35},
     {-0.798230, -0.346941, -0.492404, 0.441675, -0.892964, -0.086824, -0.409576, -0.286788, 0.866025},
     {-1205.045981, -212.482120, -291.916995}}};

std::vector<std::string> number_words(const std::vector<double>& numbers) {
    std::vector<std::string> words;
    for (const double number : numbers) {
        words.push_back(fmt::format("{}", number));
    }
    return words;
}

std::vector<std::string> ik_of(const std::vector<double>& tip, const std::vector<double>& rotation) {
    std::vector<std::string> words{"arm", "ik"};
    const auto place = number_words(tip);
    words.insert(words.end(), place.begin(), place.end());
    words.push_back(fmt::format("--frame={}", fmt::join(rotation, ",")));
    words.emplace_back("--json");
    return words;
}

std::vector<double> rows_in(const nlohmann::json& rotation) {
    std::vector<double> found;
    for (const auto& row : rotation) {
        for (const auto& value : row) {
            found.push_back(value.get<double>());
        }
    }
    return found;
}

double farthest_apart(const std::vector<double>& a, const std::vector<double>& b) {
    double apart = a.size() == b.size() ? 0.0 : 1e300;
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
        apart = std::max(apart, std::abs(a[n] - b[n]));
    }
    return apart;
}

TEST(Arm, K1GivesTheWholeMatrixOfTheTool) {
    for (const WholePose& pose : whole_poses) {
        std::vector<std::string> words{"arm", "fk"};
        const auto joints = number_words(pose.joints);
        words.insert(words.end(), joints.begin(), joints.end());
        EXPECT_THAT(run(words).out, HasSubstr("rotation "));
        words.emplace_back("--json");
        const auto answer = answer_to(words);
        EXPECT_LT(farthest_apart(rows_in(answer.at("rotation")), pose.rotation), 1e-6);
    }
}

TEST(Arm, K2FindsAllFiveJointsOfAWholeMatrix) {
    for (const WholePose& pose : whole_poses) {
        const auto solutions = answer_to(ik_of(pose.tip, pose.rotation)).at("solutions");
        ASSERT_FALSE(solutions.empty());
        // Elbow up to the front comes first; the matrix is rounded to a millionth.
        EXPECT_LT(farthest_apart(solutions.at(0).get<std::vector<double>>(), pose.joints), 1e-3)
            << solutions.dump();
    }
}

TEST(Arm, K4TurnsAWholeMatrixIntoThePlaneOfTheArmOnlyIfItMay) {
    const std::vector<double> tip{700, 300, 200};
    // Turned by 90 degrees about (1, 1, 1).
    const double a = 1.0 / 3.0, b = std::sqrt(1.0 / 3.0);
    const std::vector<double> goal{a, a - b, a + b, a + b, a, a - b, a - b, a + b, a};
    const auto refused = answer_to(ik_of(tip, goal));
    EXPECT_TRUE(refused.at("solutions").empty());
    EXPECT_THAT(refused.at("reason").get<std::string>(), HasSubstr("out of the plane"));
    auto words = ik_of(tip, goal);
    words.emplace_back("--project");
    const auto answer = answer_to(words);
    const double length = std::hypot(tip[0], tip[1]);
    const double out = (-tip[1] * goal[2] + tip[0] * goal[5]) / length; // M . Z
    EXPECT_NEAR(
        answer.at("projected_deg").get<double>(), std::abs(std::asin(out)) * 180.0 / 3.14159265358979, 1e-6);
    ASSERT_FALSE(answer.at("solutions").empty());
    const auto rotation = rows_in(answer.at("rotation"));
    EXPECT_NEAR(-tip[1] * rotation[2] + tip[0] * rotation[5], 0.0, 1e-6);
    for (const auto& solution : answer.at("solutions")) {
        std::vector<std::string> fk{"arm", "fk"};
        const auto joints = number_words(solution.get<std::vector<double>>());
        fk.insert(fk.end(), joints.begin(), joints.end());
        fk.emplace_back("--json");
        const auto back = answer_to(fk);
        EXPECT_LT(farthest_apart(rows_in(back.at("rotation")), rotation), 1e-7);
        EXPECT_NEAR(back.at("x").get<double>(), tip[0], 1e-5);
        EXPECT_NEAR(back.at("z").get<double>(), tip[2], 1e-5);
    }
}

TEST(Arm, RefusesWhatIsNoFrame) {
    const auto error_of = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"arm", "ik"});
        return run(words);
    };
    const Ended skewed = error_of({"800", "0", "650", "--frame=1,0,0.5,0,1,0,0,0,0.866"});
    EXPECT_EQ(skewed.exit_code, 1);
    EXPECT_THAT(skewed.err, HasSubstr("columns 1 and 3 of the rotation matrix"));
    const Ended rolled = error_of({"800", "0", "650", "--frame=1,0,0,0,1,0,0,0,1", "--roll", "5"});
    EXPECT_EQ(rolled.exit_code, 2);
    EXPECT_THAT(rolled.err, HasSubstr("--frame already sets the roll"));
    EXPECT_EQ(error_of({"800", "0", "650", "0", "0", "1", "--frame=1,0,0,0,1,0,0,0,1"}).exit_code, 2);
    EXPECT_EQ(error_of({"800", "0", "650"}).exit_code, 2);
    EXPECT_EQ(error_of({"800", "0", "650", "--frame=1,0,0"}).exit_code, 2);
}

// The formulas of the thesis by hand, for the upper arm upright and the forearm level: A4 = 180 / (9 / 640),
// A5 = 580 / (9 / 640), A2 and A3 by the law of cosines with sides of 538.516 and 250 mm.
TEST(Arm, K6TurnsJointsIntoCountsOfTheDrivesAndBack) {
    const auto answer = answer_to({"arm", "actuators", "0", "-90", "90", "0", "0", "--json"});
    const auto& drives = answer.at("drives");
    const double degree = std::acos(-1.0) / 180.0;
    const double alpha = std::hypot(500.0, 200.0), fixed_angle = std::atan(200.0 / 500.0);
    const auto length = [&](double angle) {
        return std::sqrt(alpha * alpha + 250.0 * 250.0 - 2.0 * alpha * 250.0 * std::cos(angle));
    };
    const double second = length((-90.0 - 70.0 + 270.0) * degree - fixed_angle);
    const double third = length(90.0 * degree - fixed_angle);
    EXPECT_NEAR(drives.at(1).at("length_mm").get<double>(), second, 1e-6);
    EXPECT_NEAR(drives.at(2).at("length_mm").get<double>(), third, 1e-6);
    EXPECT_NEAR(drives.at(1).at("counts").get<double>(), (second - 350.0) / 0.01, 1e-4);
    EXPECT_NEAR(drives.at(3).at("counts").get<double>(), 12'800.0, 1e-6);
    EXPECT_NEAR(drives.at(4).at("counts").get<double>(), 580.0 * 640.0 / 9.0, 1e-6);
    EXPECT_NEAR(drives.at(4).at("low").get<double>(), 32'000.0 - 12'800.0, 1e-6);
    EXPECT_NEAR(drives.at(4).at("high").get<double>(), 55'000.0, 1e-6);
    EXPECT_NEAR(
        drives.at(2).at("low").get<double>(), drives.at(1).at("counts").get<double>() - 10'000.0, 1e-6);
    EXPECT_NEAR(
        drives.at(0).at("low").get<double>(), -175.0 * 120.0, 1e-6); // joint 1 at 120 counts per degree
    EXPECT_TRUE(answer.at("inside_limits").get<bool>());
    std::vector<std::string> back{"arm", "actuators", "--counts", "--json"};
    for (const auto& drive : drives) {
        back.push_back(fmt::format("{}", drive.at("counts").get<double>()));
    }
    const auto joints = answer_to(back).at("joints").get<std::vector<double>>();
    EXPECT_LT(farthest_apart(joints, {0, -90, 90, 0, 0}), 1e-6);
    const Ended table = run({"arm", "actuators", "0", "-90", "90", "0", "0"});
    EXPECT_THAT(table.out, testing::ContainsRegex("A4 +12800.000"));
    const Ended open = run({"arm", "actuators", "0", "20", "60", "0", "0"});
    EXPECT_THAT(open.out, HasSubstr("outside: drive 2 would have to open its triangle"));
    EXPECT_THAT(run({"arm", "actuators", "--counts", "0", "1e6", "0", "0", "0"}).err,
                HasSubstr("drive 2 would be 10350.000 mm long"));
    EXPECT_THAT(run({"arm", "actuators", "0", "0", "0", "0", "--arm", "scara"}).err,
                HasSubstr("its file describes none"));
    EXPECT_THAT(run({"arm", "actuators", "--counts", "0", "0"}).err, HasSubstr("2 counts were given"));
}

// Forward kinematics and the drives judge a pose by all limits alike.
TEST(Arm, FkAndActuatorsAgreeOnWhatIsInsideTheLimits) {
    using Joints = std::vector<std::string>;
    for (const auto& [joints, reason] :
         {std::pair(Joints{"0", "-90", "90", "0", "0"}, std::string()),
          {Joints{"0", "20", "60", "0", "0"}, "drive 2 would have to open its triangle"},
          {Joints{"200", "-90", "90", "0", "0"}, "is outside its limits"}}) {
        const auto answer_of = [&](const char* command) {
            std::vector<std::string> words{"arm", command, "--json"};
            words.insert(words.end(), joints.begin(), joints.end());
            return answer_to(words);
        };
        const auto by_joints = answer_of("fk"), by_drives = answer_of("actuators");
        EXPECT_EQ(by_joints.at("inside_limits"), reason.empty());
        EXPECT_EQ(by_joints.at("inside_limits"), by_drives.at("inside_limits"));
        EXPECT_EQ(by_joints.at("reasons"), by_drives.at("reasons"));
        EXPECT_THAT(by_joints.at("reasons").dump(), HasSubstr(reason));
    }
}

TEST(Arm, SolvesOtherArmsToo) {
    EXPECT_EQ(answer_to({"arm", "ik", "400", "100", "250", "0", "0", "-1", "--arm", "scara", "--json"})
                  .at("solutions")
                  .size(),
              2U);
    EXPECT_GE(answer_to({"arm", "ik", "400", "100", "500", "0", "0", "-1", "--arm", "six-axis", "--json"})
                  .at("solutions")
                  .size(),
              2U);
}

/// The arm that ships, but for a joint 6 that hardly turns.
std::string arm_of_little_roll(const ScratchFolder& scratch) {
    nlohmann::json arm = nlohmann::json::parse(content_of("assets/arms/six-axis.json"));
    arm.at("joints").at(5).at("limits") = {-30.0, 30.0};
    const std::string file = (scratch / "little-roll.json").string();
    write_content(file, arm.dump());
    return file;
}

// The command asked for one roll for all, which had not been given, and found nothing.
TEST(Arm, TakesAnyRollUnlessOneIsAskedFor) {
    const ScratchFolder scratch;
    const std::string arm = arm_of_little_roll(scratch);
    const auto number = [](const nlohmann::json& value) {
        return fmt::format("{:.9f}", value.get<double>());
    };
    const std::vector<std::vector<double>> poses{
        {20, -10, -40, 15, 50, 12}, {-60, 30, -90, -100, 70, -25}, {0, 0, 0, 0, 90, 29}};
    for (const std::vector<double>& pose : poses) {
        std::vector<std::string> fk{"arm", "fk"};
        for (const double joint : pose) {
            fk.push_back(fmt::format("{}", joint));
        }
        fk.insert(fk.end(), {"--arm", arm, "--json"});
        const auto tool = answer_to(fk);
        std::vector<std::string> ik{"arm",
                                    "ik",
                                    number(tool.at("x")),
                                    number(tool.at("y")),
                                    number(tool.at("z")),
                                    number(tool.at("tool").at(0)),
                                    number(tool.at("tool").at(1)),
                                    number(tool.at("tool").at(2)),
                                    "--arm",
                                    arm,
                                    "--json"};
        EXPECT_FALSE(answer_to(ik).at("solutions").empty());
        ik.insert(ik.end(), {"--roll", number(tool.at("roll"))});
        const auto rolled = answer_to(ik).at("solutions");
        EXPECT_TRUE(std::ranges::any_of(rolled, [&](const nlohmann::json& solution) {
            double apart = 0.0;
            for (std::size_t n = 0; n < pose.size(); ++n) {
                apart = std::max(apart, std::abs(solution.at(n).get<double>() - pose[n]));
            }
            return apart < 1e-3;
        })) << rolled.dump();
    }
}

TEST(Arm, MakesItsBodies) {
    const ScratchFolder scratch;
    const std::string out = (scratch / "arm.glb").string();
    const Ended ended = run({"arm", "bodies", "--out", out});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(content_of(out), content_of("assets/arms/motoman-l3.glb"));
    EXPECT_THAT(run({"arm", "bodies", "--out", out, "--arm", "scara"}).err,
                HasSubstr("linkages, which its file does not describe"));
}

TEST(Arm, RefusesWhatIsNoPoseAndNoArm) {
    EXPECT_THAT(run({"arm", "fk", "0", "0"}).err, HasSubstr("has 5 joints, but 2 positions were given"));
    EXPECT_THAT(run({"arm", "fk", "nan", "0", "0", "0", "0"}).err, HasSubstr("not a finite number"));
    EXPECT_THAT(run({"arm", "ik", "1", "2", "3", "0", "0", "0"}).err, HasSubstr("no direction"));
    EXPECT_THAT(run({"arm", "ik", "1e300", "2", "3", "0", "0", "1"}).err,
                HasSubstr("farther away than 1e+06 mm"));
    EXPECT_THAT(run({"arm", "fk", "0", "0", "0", "0", "0", "--arm", "puma"}).err,
                HasSubstr("known: motoman-l3, scara, six-axis"));
    EXPECT_EQ(run({"arm", "ik", "1", "2"}).exit_code, 2);
}

TEST(Arm, HelpsWithSettingUp) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "angles.csv").string();
    write_content(file, "1 0 1\n1 1200 11\n1 2400 21\n");
    const auto fits = answer_to({"arm", "calibrate", file, "--json"});
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_NEAR(fits.at(0).at("counts_per_deg").get<double>(), 120.0, 1e-9);
    EXPECT_NEAR(fits.at(0).at("counts_at_zero").get<double>(), -120.0, 1e-6);
    write_content(file, "# nothing\n");
    EXPECT_THAT(run({"arm", "calibrate", file}).err, HasSubstr("no readings"));
    const Ended resistors = run({"arm", "amplifier", "--peak", "16", "--nominal", "7", "--limit", "12"});
    EXPECT_THAT(resistors.out, HasSubstr("18.18 kOhm"));
    EXPECT_THAT(resistors.out, HasSubstr("model 8/16: 18.00 kOhm"));
    EXPECT_THAT(resistors.out, HasSubstr("6.60 kOhm"));
    EXPECT_THAT(run({"arm", "amplifier", "--peak", "7", "--nominal", "16"}).err, HasSubstr("7 A, is below"));
    EXPECT_THAT(run({"arm", "amplifier", "--peak", "16", "--nominal", "9"}).err, HasSubstr("less than 9 A"));
    EXPECT_EQ(run({"arm", "amplifier"}).exit_code, 2);
    EXPECT_EQ(run({"arm", "amplifier", "--nominal", "7"}).exit_code, 2);
    const Ended pins = run({"arm", "wiring", "2"});
    EXPECT_THAT(pins.out, HasSubstr("check before wiring"));
    EXPECT_THAT(pins.out, testing::ContainsRegex("DAC +44  thesis only"));
    EXPECT_THAT(run({"arm", "wiring"}).out, testing::ContainsRegex("DAC .* confirmed of motor 1"));
    EXPECT_EQ(run({"arm", "wiring", "5"}).exit_code, 2);
}

} // namespace
} // namespace millwright::test
