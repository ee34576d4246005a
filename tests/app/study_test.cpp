#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// T24.
TEST(StudyCommand, CountsTheFewestPoints) {
    const ScratchFolder scratch;
    const Ended ended =
        run({"study", "fewest-points", "--tracks", "2", "--tolerance", "0.5", "--out", scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("two-bell on ac-table, 2 tracks\n"));
    EXPECT_THAT(content_of(scratch / "out/fewest-points.csv"), HasSubstr("\ntwo-bell,ac-table,2,0.5,"));
    EXPECT_NE(run({"study", "fewest-points", "--tolerance", "0"}).exit_code, 0);
    EXPECT_EQ(run({"study", "fewest-points", "--surface", "dune"}).exit_code, 1);
}

// T23: the speed of this machine is not known here; the tables are there, and the nodes the same.
TEST(StudyCommand, TimesTheAdaptationBesideTheThesis) {
    const ScratchFolder scratch;
    const Ended ended = run({"study",
                             "run-time",
                             "--side",
                             "50,9",
                             "--threads",
                             "1,2",
                             "--iterations",
                             "2",
                             "--repeats",
                             "1",
                             "--out",
                             scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(
        ended.out,
        AllOf(HasSubstr("Table 7-1: 2 iterations on 1 thread."), HasSubstr("Table 7-2"), HasSubstr("-O3")));
    EXPECT_THAT(ended.out, HasSubstr(" 53.3 ")) << "the thesis's 479.352 s for 18 iterations on 2500 nodes";
    const std::string rows = content_of(scratch / "out/run-time.csv");
    EXPECT_THAT(rows, AllOf(HasSubstr("\n2500,1,2,"), HasSubstr("\n2500,2,2,"), HasSubstr("\n81,2,2,")));
    EXPECT_EQ(rows.find(",0\n"), std::string::npos) << "other nodes on other threads";
    EXPECT_THAT(content_of(scratch / "out/run-time-profile.csv"), HasSubstr("\n2500,"));
    EXPECT_EQ(run({"study", "run-time", "--side", "2"}).exit_code, 2);
}

TEST(StudyCommand, WritesAPictureOfOneNumberOfPointsTooAndSetsAnUnfinishedStudyAside) {
    const ScratchFolder scratch;
    std::filesystem::create_directories(scratch / "out/unfinished");
    for (const char* name :
         {"kinematic-error.csv", "missing.txt", "dome-rotary-tilt-listing.png", "notes.txt"}) {
        write_content(scratch / "out/unfinished" / name, "left");
    }
    const Ended ended = run({"study",
                             "kinematic-error",
                             "--quick",
                             "--surface",
                             "dome",
                             "--machine",
                             "rotary-tilt-listing",
                             "--out",
                             scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(scratch / "out/dome-rotary-tilt-listing.png"), StartsWith("\x89PNG"));
    const auto study = nlohmann::json::parse(content_of(scratch / "out/kinematic-error.json"));
    EXPECT_EQ(study.at("rows")[2].at("method"), "elliptic");
    EXPECT_TRUE(study.at("rows")[2].at("no_gain"));
    EXPECT_THAT(content_of(scratch / "out/kinematic-error.md"), HasSubstr(" (no gain) | "));
    EXPECT_THAT(ended.out, HasSubstr("  no gain\n"));
    EXPECT_THAT(ended.out, HasSubstr("\nno gain: the method found nothing better than"));
    EXPECT_THAT(ended.err, AllOf(HasSubstr(" 1 case\n"), Not(HasSubstr("rank"))));
    EXPECT_FALSE(std::filesystem::exists(scratch / "out/unfinished"));
    const std::filesystem::path aside = scratch / "out/unfinished-1";
    EXPECT_THAT(ended.err, HasSubstr("the results of an earlier study are now in " + aside.string()));
    for (const char* name : {"kinematic-error.csv", "missing.txt", "notes.txt"}) {
        EXPECT_EQ(content_of(aside / name), "left") << name;
    }
}

/// A folder with what an earlier, whole study left.
void leave_old_study(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const char* name : {"kinematic-error.csv", "kinematic-error.json", "kinematic-error.md"}) {
        write_content(folder / name, "an earlier study");
    }
}

void expect_old_study(const std::filesystem::path& folder) {
    for (const char* name : {"kinematic-error.csv", "kinematic-error.json", "kinematic-error.md"}) {
        EXPECT_EQ(content_of(folder / name), "an earlier study") << name;
    }
}

TEST(StudyCommand, StoppedBeforeItsFirstCaseItWritesNothing) {
    const ScratchFolder scratch;
    leave_old_study(scratch / "out");
    Program program({"study", "kinematic-error", "--surface", "dome", "--out", scratch / "out"});
    program.wait_for_error_text("15 cases\n");
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("stopped after 0 of 15 cases: nothing is written"));
    expect_old_study(scratch / "out");
    EXPECT_FALSE(std::filesystem::exists(scratch / "out/unfinished"));
}

TEST(StudyCommand, StoppedLaterItWritesWhatIsDoneApartFromAWholeStudy) {
    const ScratchFolder scratch;
    const auto out = scratch / "out";
    leave_old_study(out);
    Program program({"study", "kinematic-error", "--quick", "--surface", "dome", "--out", out});
    program.wait_for_error_text("\n 6"); // of the work of three cases
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(" of 3 cases: they are in " + (out / "unfinished").string()));
    expect_old_study(out);
    EXPECT_FALSE(std::filesystem::exists(out / "dome-rotary-tilt-listing.png"));
    EXPECT_THAT(content_of(out / "unfinished/kinematic-error.csv"),
                HasSubstr("\ndome,rotary-tilt-listing,12,"));
    EXPECT_THAT(content_of(out / "unfinished/dome-rotary-tilt-listing.png"), StartsWith("\x89PNG"));
    EXPECT_THAT(content_of(out / "unfinished/missing.txt"),
                AllOf(StartsWith("not in these tables: "), HasSubstr(" of 3 cases\n")));
}

TEST(StudyCommand, NamesWhatTheStudyDoesNotHave) {
    const ScratchFolder scratch;
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"study",
                                       "kinematic-error",
                                       "--surface",
                                       "dome",
                                       "--machine",
                                       "ca-head",
                                       "--out",
                                       scratch / "out"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Ended surface = with({"--surface", "foo"});
    EXPECT_EQ(surface.exit_code, 2);
    EXPECT_THAT(surface.err, HasSubstr("--surface foo is not in the study"));
    EXPECT_THAT(surface.err, HasSubstr("dome, sine, two-bell, saddle"));
    const Ended machine = with({"--machine", "ac-table"});
    EXPECT_EQ(machine.exit_code, 2);
    EXPECT_THAT(machine.err, HasSubstr("--machine ac-table is not in the study"));
    const Ended points = with({"--points", "15", "--points", "17"});
    EXPECT_EQ(points.exit_code, 2);
    EXPECT_THAT(points.err, HasSubstr("--points 17 is not in the study"));
    const Ended quick = with({"--quick", "--points", "12", "--points", "20"});
    EXPECT_EQ(quick.exit_code, 2);
    EXPECT_THAT(quick.err, HasSubstr("--quick --points 20 is not in the study"));
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

/// `millwright study set-up` of a few places and nodes, the project there written to `accepted`.
Ended set_up_study(const ScratchFolder& scratch,
                   const std::string& project,
                   const std::string& accepted,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{
        "study", "set-up", project, "--out", scratch / "out", "--places", "5", "--nodes", "6"};
    words.insert(words.end(), {"--accept", accepted});
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

TEST(StudyCommand, APartIsNotMovedForAGainOfTheSizeOfRounding) {
    const ScratchFolder scratch;
    const auto project =
        small_project(scratch.path(), "dome", "\"file\": \"rotary-tilt-listing\"", "\"file\": \"ca-head\"");
    const std::string accepted = scratch / "there.json";
    const Ended ended = set_up_study(scratch, project, accepted);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\nno gain: "));
    EXPECT_FALSE(nlohmann::json::parse(content_of(accepted)).at("machine").contains("workpiece_offset"));
}

TEST(StudyCommand, SaysThatAPartLargerThanTheMachineIsOutOfReach) {
    const ScratchFolder scratch;
    auto json = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    for (auto& row : json.at("surface").at("patches").at(0).at("points")) {
        for (auto& point : row) {
            for (auto& number : point) {
                number = 20.0 * number.get<double>();
            }
        }
    }
    const std::string project = scratch / "large.json";
    write_content(project, json.dump());
    const Ended ended = set_up_study(scratch, project, scratch / "there.json");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("cannot reach the whole part from any position in the search range (a "),
                      HasSubstr(" cannot be reached: axis Y would have to move to "),
                      HasSubstr("make the part smaller")));
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << "no map of nothing";
    EXPECT_FALSE(std::filesystem::exists(scratch / "there.json"));
}

TEST(StudyCommand, TellsOfAStartAndOfPlacesOfTheMapThatAreOutOfReach) {
    const ScratchFolder scratch;
    const auto project = small_project(
        scratch.path(), "dome", "\"angle_mode\"", "\"workpiece_offset\": [900, 0, 175], \"angle_mode\"");
    const Ended ended = set_up_study(scratch, project, scratch / "there.json", {"--reach", "600"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out,
                AllOf(HasSubstr("\nthe start is out of reach: path point "),
                      HasSubstr(" cannot be reached: axis "),
                      HasSubstr("\nout of reach: "),
                      HasSubstr(" of 25 positions of the map\n")));
}

TEST(StudyCommand, MapsTheSetUpAndWritesTheProjectThere) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    const std::string accepted = scratch / "there.json";
    const Ended ended = set_up_study(scratch, project, accepted, {"--up", "c"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\nstart "));
    EXPECT_THAT(ended.out, HasSubstr("\nbest "));
    EXPECT_THAT(ended.out, HasSubstr(" mean mm  axis deg\n"));
    EXPECT_THAT(content_of(scratch / "out/set-up.csv"), StartsWith("a_mm,c_mm,cost_mm,axis_deg_to_curve\n"));
    EXPECT_THAT(content_of(scratch / "out/set-up.png"), StartsWith("\x89PNG"));
    const auto json = nlohmann::json::parse(content_of(accepted));
    EXPECT_TRUE(json.at("machine").contains("workpiece_offset"));
    const Ended same = run({"study", "set-up", project, "--out", scratch / "out", "--across", "b"});
    EXPECT_EQ(same.exit_code, 1);
    EXPECT_THAT(same.err, HasSubstr("are the same"));
}

} // namespace
} // namespace millwright::test
