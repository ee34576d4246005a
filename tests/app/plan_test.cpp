#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <string>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// T24.
TEST(PlanCommand, LeavesProgramReportAndPicture) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended ended = run({"plan", project, "--out", scratch / "new/out"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const std::string program = content_of(scratch / "new/out/program.ngc");
    EXPECT_THAT(program, HasSubstr("G93"));
    EXPECT_THAT(program, HasSubstr("mm on average inside the tracks)\n(note: only this face was checked)\n"));
    EXPECT_THAT(ended.out, HasSubstr("\ndistances: only this face was checked, not the adjacent faces "));
    EXPECT_THAT(content_of(scratch / "new/out/preview.png"), StartsWith("\x89PNG"));
    const auto report = nlohmann::json::parse(content_of(scratch / "new/out/report.json"));
    EXPECT_EQ(report.at("grid").at("nu"), 6);
    EXPECT_THAT(ended.out, HasSubstr("tracks"));
    EXPECT_EQ(report.at("error").at("adapted").at("status"), "no-gain");
    EXPECT_THAT(ended.out, HasSubstr("\nno gain: elliptic: "));
    for (const auto& entry : fs::directory_iterator(scratch / "new/out")) {
        EXPECT_THAT(entry.path().filename().string(), Not(StartsWith("."))) << "a draft was left behind";
    }
}

TEST(PlanCommand, WithoutOpenGlLeavesOutThePicture) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    fs::create_directory(scratch / "out");
    write_content(scratch / "out/preview.png", "of an earlier plan");
    ASSERT_EQ(setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json", 1), 0);
    const Ended ended = run({"plan", project, "--out", scratch / "out"});
    ASSERT_EQ(unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES"), 0);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("warning: no preview.png: cannot draw without a display: "));
    EXPECT_THAT(content_of(scratch / "out/program.ngc"), HasSubstr("G93"));
    EXPECT_FALSE(fs::exists(scratch / "out/preview.png"));
}

// The elliptic grid stayed uniform, unsaid.
TEST(PlanCommand, WarnsOfAMixWithoutAnyShare) {
    const ScratchFolder scratch;
    const std::string mix = R"("mix": {"error": 0, "combination": "sum"}, "weight": "mixed")";
    std::string text = content_of(small_project(scratch.path(), "dome", "\"weight\": \"error\"", mix));
    const std::size_t method = text.find("\"method\": \"");
    text.replace(method, text.find(',', method) - method, "\"method\": \"elliptic\"");
    write_content(scratch / "mixed.json", text);
    const Ended ended = run({"plan", scratch / "mixed.json", "--out", scratch / "out"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("warning: All shares of the mixed weight are 0 (grid/elliptic/mix)"));
    EXPECT_THAT(content_of(scratch / "out" / "report.json"),
                HasSubstr("All shares of the mixed weight are 0"));
}

TEST(PlanCommand, LeavesNoEmptyFolderWhereItFails) {
    const ScratchFolder scratch;
    const fs::path project =
        small_project(scratch.path(), "dome", "\"rotary-tilt-listing\"", "\"no-such-machine\"");
    EXPECT_EQ(run({"plan", project, "--out", scratch / "new/out"}).exit_code, 1);
    EXPECT_FALSE(fs::exists(scratch / "new"));
    fs::create_directory(scratch / "old");
    EXPECT_EQ(run({"plan", project, "--out", scratch / "old"}).exit_code, 1);
    EXPECT_TRUE(fs::exists(scratch / "old")) << "it was there before";
}

/// It was an internal error, and "new" stayed.
TEST(PlanCommand, SaysThatAFolderCannotBeMadeAndLeavesNothingOfIt) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended ended = run({"plan", project, "--out", scratch / "new" / std::string(300, 'n')});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("cannot create the folder: "), Not(HasSubstr("internal error"))));
    EXPECT_FALSE(fs::exists(scratch / "new"));
}

TEST(PlanCommand, RemovesTheFolderThatItMadeWhereTheWayThereGoesUp) {
    const ScratchFolder scratch;
    const fs::path project =
        small_project(scratch.path(), "dome", "\"rotary-tilt-listing\"", "\"no-such-machine\"");
    fs::create_directories(scratch / "elsewhere/inner");
    fs::create_directory_symlink(scratch / "elsewhere/inner", scratch / "link");
    EXPECT_EQ(run({"plan", project, "--out", scratch / "link/../out"}).exit_code, 1);
    EXPECT_TRUE(fs::is_empty(scratch / "elsewhere/inner"));
    EXPECT_FALSE(fs::exists(scratch / "elsewhere/out")) << "where the link leads";
    EXPECT_EQ(run({"plan", project, "--out", scratch / "new/../out"}).exit_code, 1);
    EXPECT_FALSE(fs::exists(scratch / "new"));
    EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST(PlanCommand, ChoosesTheRotaryAxesForTheWholePath) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "two-bell");
    const Ended ended =
        run({"plan", project, "--out", scratch / "out", "--sequencing", "travel", "--largest-step", "15"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\nbefore "));
    EXPECT_THAT(ended.out, HasSubstr("\ntravel "));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/report.json"));
    EXPECT_LE(report.at("error").at("optimised").at("largest_rotary_step_deg"), 15.0);
    EXPECT_LE(report.at("error").at("uniform").at("largest_rotary_step_deg"), 15.0);
    EXPECT_EQ(report.at("machine").at("sequencing"), "travel");
    EXPECT_GT(report.at("points"), 36);
    ASSERT_EQ(run({"plan", project, "--out", scratch / "plain"}).exit_code, 0);
    const auto plain = nlohmann::json::parse(content_of(scratch / "plain/report.json"));
    EXPECT_GT(plain.at("error").at("uniform").at("largest_rotary_step_deg"), 15.0);
    EXPECT_EQ(plain.at("points"), 36);
    EXPECT_NE(run({"plan", project, "--out", scratch / "out", "--sequencing", "luck"}).exit_code, 0);
}

// It ended with 0 and wrote the program, with a warning somewhere above.
TEST(PlanCommand, WritesNoProgramThatGougesThePart) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended ended =
        run({"plan", project, "--out", scratch / "out", "--tool", "assets/tools/ball-6.json"});
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_THAT(ended.err, HasSubstr("below the surface; the limit is 0.1 mm"));
    EXPECT_THAT(ended.err, HasSubstr("program.ngc was not written"));
    EXPECT_FALSE(fs::exists(scratch / "out/program.ngc"));
    EXPECT_TRUE(fs::exists(scratch / "out/report.json"));
}

TEST(PlanCommand, CutsWithTheToolOfAFile) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended ended = run({"plan",
                             project,
                             "--out",
                             scratch / "out",
                             "--tool",
                             "assets/tools/bull-nose-10.json",
                             "--allow-gouges"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("tool: bull-nose, diameter 10 mm"));
    EXPECT_THAT(ended.out, HasSubstr("scallop height: "));
    EXPECT_THAT(content_of(scratch / "out/program.ngc"), HasSubstr("bull-nose"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/report.json"));
    EXPECT_EQ(report.at("tool").at("cutter"), "bull-nose");
    EXPECT_GT(report.at("cut").at("scallop_mm").at("max"), 0.0);
}

TEST(PlanCommand, AComparedGridThatFailsIsAWarning) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    auto json = nlohmann::json::parse(content_of(project));
    json["grid"]["elliptic"]["weight"] = "expression";
    json["grid"]["elliptic"]["expression"] = "1/(u-u)";
    write_content(scratch / "fails.json", json.dump());
    const Ended ended = run({"plan", scratch / "fails.json", "--out", scratch / "out"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("warning: no elliptic grid to compare with: "));
    EXPECT_THAT(ended.out, HasSubstr("\nelliptic   failed\n"));
    EXPECT_THAT(content_of(scratch / "out/program.ngc"), HasSubstr("G93"));
    json["grid"]["elliptic"]["expression"] = "u - 0.5";
    write_content(scratch / "warns.json", json.dump());
    const Ended warned = run({"plan", scratch / "warns.json", "--out", scratch / "out"});
    EXPECT_EQ(warned.exit_code, 0) << warned.err;
    EXPECT_THAT(warned.err, HasSubstr("warning: elliptic grid: The weight is not positive at "));
}

TEST(PlanCommand, WritesOverNoProjectInItsFolder) {
    const ScratchFolder scratch;
    const fs::path project = scratch / "report.json";
    fs::rename(small_project(scratch.path(), "dome"), project);
    const std::string bytes = content_of(project);
    const Ended ended = run({"plan", project, "--out", scratch.path()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("report.json: would be overwritten, but is an input file"));
    EXPECT_EQ(content_of(project), bytes);
    EXPECT_FALSE(fs::exists(scratch / "program.ngc"));
}

TEST(PlanCommand, BetterGridsAreNotWorse) {
    const ScratchFolder scratch;
    for (const char* name : {"dome", "two-bell", "sine"}) {
        const Ended ended =
            run({"plan", small_project(scratch.path(), name), "--out", (scratch / name).string()});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const auto error = nlohmann::json::parse(content_of(scratch / name / "report.json")).at("error");
        for (const char* better : {"adapted", "optimised"}) {
            EXPECT_LE(error.at(better).at("closest").at("mean"), error.at("uniform").at("closest").at("mean"))
                << name << better;
            EXPECT_LE(error.at(better).at("axis_deviation_deg").at("max"),
                      error.at("uniform").at("axis_deviation_deg").at("max"))
                << name << better;
        }
    }
}

TEST(PlanCommand, TellsOfASpiralThatRunsOverTheUniformGrid) {
    const ScratchFolder scratch;
    auto json = nlohmann::json::parse(content_of(small_project(scratch.path(), "two-bell")));
    json["toolpath"]["strategy"] = "spiral";
    write_content(scratch / "spiral.json", json.dump());
    const Ended ended = run({"plan", scratch / "spiral.json", "--out", scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("warning: The spiral crosses the tracks that the grid"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/report.json"));
    EXPECT_EQ(report.at("grid").at("status"), "no-gain");
    EXPECT_THAT(report.at("remarks").at(0).get<std::string>(), StartsWith("The spiral crosses"));
}

TEST(PlanCommand, LinksOfTheChainHaveTheToolAxisBesideTheTip) {
    const ScratchFolder scratch;
    auto json = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    json["grid"]["method"] = "chain";
    write_content(scratch / "chain.json", json.dump());
    const Ended ended = run({"plan", scratch / "chain.json", "--out", scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("max mm   mean mm  axis deg  best max best mean best axis\n"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/report.json"));
    for (const auto& link : report.at("error").at("chain").at("links")) {
        EXPECT_GT(link.at("axis_max_deg"), 0.0);
        EXPECT_GT(link.at("best_axis_max_deg"), 0.0);
    }
}

TEST(PlanCommand, TwoRunsGiveTheSameBytes) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "two-bell");
    ASSERT_EQ(run({"plan", project, "--out", scratch / "a"}).exit_code, 0);
    ASSERT_EQ(run({"plan", project, "--out", scratch / "b"}).exit_code, 0);
    for (const char* name : {"program.ngc", "report.json", "preview.png"}) {
        EXPECT_EQ(content_of(scratch / "a" / name), content_of(scratch / "b" / name)) << name;
    }
}

TEST(PlanCommand, TellsItsProgressInPlainLinesWhereThereIsNoTerminal) {
    const ScratchFolder scratch;
    const Ended ended = run({"plan", small_project(scratch.path(), "dome"), "--out", scratch / "out"});
    EXPECT_THAT(ended.err, HasSubstr(" %  Optimising the tracks\n"));
    EXPECT_THAT(ended.err, Not(HasSubstr("\r")));
}

TEST(PlanCommand, IsCancelledByCtrlCAndLeavesWhatWasThere) {
    const ScratchFolder scratch;
    fs::create_directories(scratch / "out");
    write_content(scratch / "out/program.ngc", "old");
    std::string text = content_of("assets/projects/dome.json");
    for (const char* count : {"\"nu\": ", "\"nv\": "}) {
        text.replace(text.find(count), 8, std::string(count) + "100");
    }
    write_content(scratch / "large.json", text);
    Program program({"plan", scratch / "large.json", "--out", scratch / "out"});
    program.wait_for_error_text("%");
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("millwright: cancelled\n"));
    EXPECT_EQ(content_of(scratch / "out/program.ngc"), "old");
    EXPECT_FALSE(fs::exists(scratch / "out/report.json"));
}

} // namespace
} // namespace millwright::test
