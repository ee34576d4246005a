#include "tests/app/scratch_files.h"
#include "tests/app/shipped_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace millwright::test {
namespace {

using ::testing::HasSubstr;

class ReshapeCommand : public ScratchFiles {};

TEST_F(ReshapeCommand, RaisesTheDegreeAndSplits) {
    const Ended ended =
        run({"reshape", dome_project, "--degree", "4,5", "--split-u", "0.25", "--out", path("two.json")});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, "patch 0: degree 4 x 5, machined\npatch 1: degree 4 x 5\n");
    const nlohmann::json patches =
        nlohmann::json::parse(content_of(path("two.json"))).at("surface").at("patches");
    ASSERT_EQ(patches.size(), 2U);
    EXPECT_EQ(patches[0]["points"].size(), 5U);
    EXPECT_EQ(patches[0]["points"][0].size(), 6U);
    EXPECT_EQ(patches[0]["points"][4][2], patches[1]["points"][0][2]) << "they meet";
    EXPECT_EQ(run({"plan", path("two.json"), "--out", path("plan")}).exit_code, 0);
}

TEST_F(ReshapeCommand, LaysThePartOnItsBackAndPlansIt) {
    ASSERT_EQ(run({"reshape", dome_project, "--turn", "180,0,0", "--out", path("back.json")}).exit_code, 0);
    const auto points = [](const std::string& file) {
        return nlohmann::json::parse(content_of(file)).at("surface").at("patches")[0].at("points");
    };
    const nlohmann::json before = points(dome_project), after = points(path("back.json"));
    for (std::size_t i = 0; i < before.size(); ++i) {
        for (std::size_t j = 0; j < before[i].size(); ++j) {
            EXPECT_EQ(after[i][j][0], before[i][j][0]);
            EXPECT_EQ(after[i][j][1].get<double>(), -before[i][j][1].get<double>());
            EXPECT_EQ(after[i][j][2].get<double>(), -before[i][j][2].get<double>());
        }
    }
    nlohmann::json back = nlohmann::json::parse(content_of(path("back.json")));
    back["surface"]["flipped"] = true; // the other side is above now
    write_content(path("back.json"), back.dump());
    const Ended planned = run({"plan", path("back.json"), "--out", path("plan")});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
}

TEST_F(ReshapeCommand, SaysWhatIsWrong) {
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"reshape", dome_project, "--out", path("no.json")};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_NE(ended.exit_code, 0);
        return ended.err;
    };
    EXPECT_THAT(refused({}), HasSubstr("give --degree, --split-u, --split-v or --turn"));
    EXPECT_THAT(refused({"--degree", "2,3"}), HasSubstr("would change its shape"));
    EXPECT_THAT(refused({"--degree", "3"}), HasSubstr("--degree"));
    EXPECT_THAT(refused({"--split-v", "1"}), HasSubstr("between 0.01 and 0.99"));
    EXPECT_THAT(refused({"--split-u", "1e-9"}), HasSubstr("not at 1e-09"));
    EXPECT_THAT(refused({"--split-v", "0.5", "--patch", "7"}), HasSubstr("no patch 7"));
}

} // namespace
} // namespace millwright::test
