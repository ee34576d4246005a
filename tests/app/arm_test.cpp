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

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

nlohmann::json answer_to(const std::vector<std::string>& words) {
    const Ended ended = run(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return nlohmann::json::parse(ended.out);
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
    const auto far = answer_to({"arm", "ik", "1500", "0", "0", "0", "0", "1", "--json"});
    EXPECT_TRUE(far.at("solutions").empty());
    EXPECT_THAT(far.at("reason").get<std::string>(), HasSubstr("291.924 to 1450.000"));
    // Nearer than joint 3 can bend, though the links alone would reach it.
    const auto near = answer_to({"arm", "ik", "0", "200", "0", "0", "0", "1", "--json"});
    EXPECT_TRUE(near.at("solutions").empty());
    EXPECT_EQ(near.at("reason").get<std::string>(),
              "the wrist would be 200.000 mm from the shoulder; the arm reaches 291.924 to 1450.000");
    const std::vector<std::string> leaning{"arm", "ik", "800", "100", "0", "0", "0.6", "0.8", "--json"};
    EXPECT_THAT(answer_to(leaning).at("reason").get<std::string>(), HasSubstr("out of the plane"));
    auto projected = leaning;
    projected.emplace_back("--project");
    EXPECT_FALSE(answer_to(projected).at("solutions").empty());
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

// The command asked for one roll of all, which nobody had named, and found nothing.
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

TEST(Arm, SimulatesTheFileOfTheThesis) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "three-lines.mot").string(), out = (scratch / "result.txt").string();
    write_content(file, "G1 X300 Y0 Z0 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;\n");
    const Ended ended = run({"arm", "simulate", file, "--step", "10", "--out", out});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("3 blocks, 75 points"));
    EXPECT_THAT(content_of(out),
                testing::StartsWith("next position 800.00000 0.00000 650.00000 \n\n 1 := 0.00000 \n"
                                    " 2 := -90.00000 \n 3 := 90.00000 \n"));
    write_content(file, "X300 ;\nX3000 ;");
    EXPECT_THAT(run({"arm", "simulate", file, "--out", out}).err,
                HasSubstr("three-lines.mot:2: the arm does not"));
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
    EXPECT_THAT(run({"arm", "fk", "0", "0"}).err, HasSubstr("has 5 joints, 2 positions were given"));
    EXPECT_THAT(run({"arm", "fk", "nan", "0", "0", "0", "0"}).err, HasSubstr("not a finite number"));
    EXPECT_THAT(run({"arm", "ik", "1", "2", "3", "0", "0", "0"}).err, HasSubstr("no direction"));
    EXPECT_THAT(run({"arm", "ik", "1e300", "2", "3", "0", "0", "1"}).err, HasSubstr("farther than 1e+06 mm"));
    EXPECT_THAT(run({"arm", "fk", "0", "0", "0", "0", "0", "--arm", "puma"}).err,
                HasSubstr("known: motoman-l3, scara, six-axis"));
    EXPECT_EQ(run({"arm", "ik", "1", "2"}).exit_code, 2);
}

TEST(Arm, SaysHowMuchOfAProgramItReaches) {
    const ScratchFolder scratch;
    write_content((scratch / "part.ngc").string(),
                  "G21 G90 F600\nG0 X0 Y0 Z5\nG1 Z0\nG1 X200\nG1 X900\nG1 X0\nM2\n");
    const auto asked = [&](const std::string& frame) {
        return run({"arm", "reach", (scratch / "part.ngc").string(), "--frame", frame, "--json"});
    };
    const Ended near = asked("700,0,-200,0,0,90");
    ASSERT_EQ(near.exit_code, 0) << near.err;
    const auto whole = nlohmann::json::parse(near.out);
    EXPECT_TRUE(whole.at("whole").get<bool>());
    EXPECT_NEAR(whole.at("length_mm").get<double>(), 1805.0, 1e-6);
    EXPECT_NEAR(whole.at("programmed_seconds").get<double>(), 180.5, 1e-6);
    EXPECT_GE(whole.at("planned_seconds").get<double>(), 180.5);
    EXPECT_LE(whole.at("planned_seconds").get<double>(), 190.0);
    // Along x the arm ends at 1450 mm from its shoulder.
    const Ended far = asked("700,0,-200,0,0,0");
    ASSERT_EQ(far.exit_code, 1);
    const auto part = nlohmann::json::parse(far.out);
    EXPECT_TRUE(part.at("planned_seconds").is_null());
    ASSERT_EQ(part.at("findings").size(), 1U);
    const auto& finding = part.at("findings").at(0);
    EXPECT_EQ(finding.at("first_line"), 5);
    EXPECT_EQ(finding.at("last_line"), 6);
    const double reached = std::sqrt(1450.0 * 1450.0 - 200.0 * 200.0) - 700.0;
    EXPECT_NEAR(part.at("reached_mm").get<double>(), 5.0 + 2.0 * reached, 1.0);
}

TEST(Arm, RefusesProgramsThatItCannotRead) {
    const ScratchFolder scratch;
    write_content((scratch / "five.ngc").string(), "G21 G90 F600\nG1 X1 A10\nM2\n");
    EXPECT_THAT(run({"arm", "reach", "assets/samples/plot/hatched-sign.plt"}).err,
                HasSubstr("hatched-sign.plt: a plot is no program yet"));
    EXPECT_THAT(run({"arm", "reach", (scratch / "nofile.plt").string()}).err,
                AllOf(HasSubstr("nofile.plt: cannot read: No such file"), Not(HasSubstr("no program yet"))));
    const Ended rotary = run({"arm", "reach", (scratch / "five.ngc").string()});
    EXPECT_EQ(rotary.exit_code, 1);
    EXPECT_THAT(rotary.err, HasSubstr("five.ngc:2"));
    EXPECT_THAT(rotary.err, HasSubstr("--machine"));
    write_content((scratch / "still.ngc").string(), "M2\n");
    EXPECT_THAT(run({"arm", "reach", (scratch / "still.ngc").string()}).err, HasSubstr("moves nothing"));
    EXPECT_THAT(run({"arm", "reach", (scratch / "five.ngc").string(), "--frame", "1,2,nan,0,0,0"}).err,
                HasSubstr("not finite"));
}

TEST(Arm, HelpsWithSettingUp) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "angles.csv").string();
    write_content(file, "1 0 1\n1 1200 11\n1 2400 21\n");
    const auto fits = answer_to({"arm", "calibrate", file, "--json"});
    ASSERT_EQ(fits.size(), 1U);
    EXPECT_NEAR(fits.at(0).at("counts_per_degree").get<double>(), 120.0, 1e-9);
    EXPECT_NEAR(fits.at(0).at("counts_at_zero").get<double>(), -120.0, 1e-6);
    write_content(file, "# nothing\n");
    EXPECT_THAT(run({"arm", "calibrate", file}).err, HasSubstr("no readings"));
    const Ended resistors = run({"arm", "amplifier", "--peak", "16", "--nominal", "7", "--limit", "12"});
    EXPECT_THAT(resistors.out, HasSubstr("18.18 kOhm"));
    EXPECT_THAT(resistors.out, HasSubstr("model 8/16: 18.00 kOhm"));
    EXPECT_THAT(resistors.out, HasSubstr("6.60 kOhm"));
    EXPECT_THAT(run({"arm", "amplifier", "--peak", "7", "--nominal", "16"}).err, HasSubstr("7 A, is less"));
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
