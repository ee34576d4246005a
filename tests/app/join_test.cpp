#include "tests/app/scratch_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace millwright::test {
namespace {

using ::testing::HasSubstr;

class JoinCommand : public ScratchFiles {
protected:
    /// A bicubic strip from x = `from`, 40 mm wide, that rises by `slope` mm per mm from `height`.
    [[nodiscard]] std::string strip(const std::string& name, double from, double height, double slope) const {
        nlohmann::json points = nlohmann::json::array();
        for (int i = 0; i < 4; ++i) {
            nlohmann::json row = nlohmann::json::array();
            for (int j = 0; j < 4; ++j) {
                const double x = 40.0 * i / 3.0;
                row.push_back({from + x, 20.0 * j, height + slope * x + (j == 1 ? 2.0 : 0.0)});
            }
            points.push_back(row);
        }
        const nlohmann::json project{{"format", "millwright-project"},
                                     {"version", 1},
                                     {"name", name},
                                     {"surface", {{"patches", {{{"points", points}}}}}},
                                     {"machine", {{"file", "ac-table"}}}};
        return written(name + ".json", project.dump());
    }
};

TEST_F(JoinCommand, ClosesTheGapAndTheEdge) {
    const std::string a = strip("a", 0.0, 0.0, 0.2);
    const std::string b = strip("b", 40.3, 8.2, -0.1);
    const Ended ended = run({"join", a, b, "--continuity", "C1", "--out", path("one.json"), "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const nlohmann::json told = nlohmann::json::parse(ended.out);
    ASSERT_EQ(told.at("seams").size(), 1U);
    const nlohmann::json& seam = told.at("seams")[0];
    EXPECT_GT(seam.at("gap_before_mm"), 0.3);
    EXPECT_GT(seam.at("angle_before_deg"), 10.0);
    EXPECT_LT(seam.at("gap_mm"), 1e-9);
    EXPECT_LT(seam.at("angle_deg"), 1e-5);
    EXPECT_EQ(told.at("patches"), 2);
    EXPECT_GT(told.at("largest_move_mm"), 0.1);
    // The file says the same: rows in line across the seam, in one ratio.
    const nlohmann::json patches =
        nlohmann::json::parse(content_of(path("one.json"))).at("surface").at("patches");
    for (int j = 0; j < 4; ++j) {
        EXPECT_NEAR(
            patches[0]["points"][3][j][2].get<double>(), patches[1]["points"][0][j][2].get<double>(), 1e-9);
    }
    EXPECT_EQ(run({"plan", path("one.json"), "--out", path("plan")}).exit_code, 0);
}

TEST_F(JoinCommand, NamesTheSeamThatStaysOpen) {
    const std::string a = strip("a", 0.0, 0.0, 0.0);
    const std::string b = strip("b", 40.3, 0.0, 0.0);
    const std::string c = strip("c", 85.3, 0.0, 0.0);
    const Ended text = run({"join", a, b, c, "--out", path("one.json")});
    ASSERT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("left open: 1 u = 1 - 2 u = 0, gap "));
    const nlohmann::json told =
        nlohmann::json::parse(run({"join", a, b, c, "--out", path("one.json"), "--json"}).out);
    ASSERT_EQ(told.at("open_seams").size(), 1U);
    const nlohmann::json& open = told.at("open_seams")[0];
    EXPECT_EQ(open.at("patches"), nlohmann::json({1, 2}));
    EXPECT_EQ(open.at("sides"), nlohmann::json({"u = 1", "u = 0"}));
    EXPECT_NEAR(open.at("gap_mm").get<double>(), 5.0, 0.5);
    const Ended wider = run({"join", a, b, c, "--gap", "6", "--out", path("one.json"), "--json"});
    EXPECT_TRUE(nlohmann::json::parse(wider.out).at("open_seams").empty());
    const Ended none = run({"join", b, c, "--out", path("one.json")});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.err, HasSubstr("open seams: 0 u = 1 - 1 u = 0 with a gap of 5.0000 mm"));
}

TEST_F(JoinCommand, SaysWhatIsWrong) {
    const std::string a = strip("a", 0.0, 0.0, 0.0);
    const std::string far_away = strip("far", 400.0, 0.0, 0.0);
    const Ended apart = run({"join", a, far_away, "--out", path("one.json")});
    EXPECT_NE(apart.exit_code, 0);
    EXPECT_THAT(apart.err, HasSubstr("no two patches have edges"));
    EXPECT_FALSE(std::filesystem::exists(path("one.json")));
    EXPECT_NE(run({"join", a, "--continuity", "C2", "--out", path("one.json")}).exit_code, 0);
}

} // namespace
} // namespace millwright::test
