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

TEST_F(ReshapeCommand, SaysWhatIsWrong) {
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"reshape", dome_project, "--out", path("no.json")};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_NE(ended.exit_code, 0);
        return ended.err;
    };
    EXPECT_THAT(refused({}), HasSubstr("give --degree, --split-u or --split-v"));
    EXPECT_THAT(refused({"--degree", "2,3"}), HasSubstr("would change its shape"));
    EXPECT_THAT(refused({"--degree", "3"}), HasSubstr("--degree"));
    EXPECT_THAT(refused({"--split-v", "1"}), HasSubstr("between 0.01 and 0.99"));
    EXPECT_THAT(refused({"--split-u", "1e-9"}), HasSubstr("not at 1e-09"));
    EXPECT_THAT(refused({"--split-v", "0.5", "--patch", "7"}), HasSubstr("there is no patch 7"));
}

} // namespace
} // namespace millwright::test
