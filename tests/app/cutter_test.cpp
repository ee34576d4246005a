#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

TEST(CutterCommand, LeavesProgramReportAndMap) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended ended = run({"cutter",
                             project,
                             "--tool",
                             "assets/tools/bull-nose-10.json",
                             "--out",
                             scratch / "out",
                             "--allow-gouges",
                             "--scallop",
                             "0.02"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("tool: bull-nose, diameter 10 mm, corner radius 2 mm"));
    EXPECT_THAT(ended.out, HasSubstr("a scallop height of 0.02 mm allows"));
    EXPECT_THAT(ended.out,
                testing::ContainsRegex("cutter error: .* deg off \\(only this face was checked\\)"));
    EXPECT_THAT(content_of(scratch / "out/program.ngc"), HasSubstr("G93"));
    EXPECT_THAT(content_of(scratch / "out/surface.csv"), StartsWith("u,v,x_mm"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/cut.json"));
    EXPECT_EQ(report.at("format"), "millwright-cut");
    EXPECT_GT(report.at("scallop_mm").at("max"), 0.0);
}

TEST(CutterCommand, ReportsAPathOfItsOwn) {
    const ScratchFolder scratch;
    auto project = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    project["toolpath"]["strategy"] = "iso-parametric";
    std::ofstream(scratch / "iso.json") << project.dump();
    const Ended ended = run({"cutter",
                             scratch / "iso.json",
                             "--tool",
                             "assets/tools/ball-6.json",
                             "--out",
                             scratch / "out",
                             "--allow-gouges"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto report = nlohmann::json::parse(content_of(scratch / "out/cut.json"));
    EXPECT_EQ(report.at("strategy"), "iso-parametric");
    EXPECT_GT(report.at("error_mm").at("max"), 0.0);
}

// 6 x 6 nodes are so few that a ball goes 2 mm below the dome between them.
TEST(CutterCommand, WritesNoProgramThatGougesThePart) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const std::vector<std::string> command{
        "cutter", project, "--tool", "assets/tools/ball-6.json", "--out", scratch / "out"};
    const Ended refused = run(command);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("program.ngc was not written"));
    EXPECT_FALSE(fs::exists(scratch / "out/program.ngc"));
    EXPECT_FALSE(nlohmann::json::parse(content_of(scratch / "out/cut.json")).at("bites").empty());
    std::vector<std::string> allowed = command;
    allowed.emplace_back("--allow-gouges");
    EXPECT_EQ(run(allowed).exit_code, 0);
    EXPECT_TRUE(fs::exists(scratch / "out/program.ngc"));
    EXPECT_EQ(run(command).exit_code, 3); // the program of before is no longer there
    EXPECT_FALSE(fs::exists(scratch / "out/program.ngc"));
}

TEST(CutterCommand, RefusesWhatIsNoTool) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended wrong = run({"cutter", project, "--tool", project, "--out", scratch / "out"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("not a tool file"));
    const Ended nothing = run({"cutter",
                               project,
                               "--tool",
                               "assets/tools/ball-6.json",
                               "--out",
                               scratch / "out",
                               "--scallop",
                               "0"});
    EXPECT_EQ(nothing.exit_code, 2);
    const Ended point = run({"cutter", project, "--out", scratch / "out"});
    EXPECT_EQ(point.exit_code, 1);
    EXPECT_THAT(point.err, HasSubstr("name a tool file with --tool"));
    EXPECT_FALSE(fs::exists(scratch / "out"));
}

} // namespace
} // namespace millwright::test
