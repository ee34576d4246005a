#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace millwright::test {
namespace {

using testing::HasSubstr;

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
}

TEST(Arm, SaysWhyNothingReachesAPoint) {
    const auto far = answer_to({"arm", "ik", "1500", "0", "0", "0", "0", "1", "--json"});
    EXPECT_TRUE(far.at("solutions").empty());
    EXPECT_THAT(far.at("reason").get<std::string>(), HasSubstr("150.000 to 1450.000"));
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

TEST(Arm, RefusesWhatIsNoPoseAndNoArm) {
    EXPECT_THAT(run({"arm", "fk", "0", "0"}).err, HasSubstr("has 5 joints, 2 positions were given"));
    EXPECT_THAT(run({"arm", "fk", "nan", "0", "0", "0", "0"}).err, HasSubstr("not a finite number"));
    EXPECT_THAT(run({"arm", "ik", "1", "2", "3", "0", "0", "0"}).err, HasSubstr("no direction"));
    EXPECT_THAT(run({"arm", "fk", "0", "0", "0", "0", "0", "--arm", "puma"}).err,
                HasSubstr("known: motoman-l3, scara, six-axis"));
    EXPECT_EQ(run({"arm", "ik", "1", "2"}).exit_code, 2);
}

} // namespace
} // namespace millwright::test
