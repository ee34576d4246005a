// What commands do with files that are there already, that never end, or whose names are strange.
#include "tests/app/program.h"
#include "tests/app/scratch_files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <memory>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

/// What commands remember is in the folder of the test.
class KeptFiles : public testing::Test {
protected:
    void SetUp() override { ::setenv("XDG_STATE_HOME", (scratch / "state").c_str(), 1); }
    void TearDown() override { ::unsetenv("XDG_STATE_HOME"); }

    ScratchFolder scratch;
    fs::path out = scratch / "out";
    fs::path logs = scratch / "logs";

    [[nodiscard]] Ended plan(const fs::path& project) const { return run({"plan", project, "--out", out}); }
    [[nodiscard]] Ended sent(const fs::path& file) const {
        return run({"send",
                    file,
                    "--driver",
                    "virtual",
                    "--machine",
                    "rotary-tilt-listing",
                    "--speed",
                    "0",
                    "--log",
                    logs});
    }
    [[nodiscard]] std::vector<std::string> drafts() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(out)) {
            if (entry.path().filename().string().starts_with('.')) {
                found.push_back(entry.path().filename().string());
            }
        }
        return found;
    }
};

TEST_F(KeptFiles, AProgramThatAPersonHasEditedIsKeptUnderAnotherName) {
    const fs::path project = small_project(scratch.path(), "dome");
    fs::create_directory(out);
    write_content(out / "program.ngc", "by hand");
    const Ended first = plan(project);
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.err,
                HasSubstr("was not written by Millwright; the old file is now program-kept-1.ngc"));
    EXPECT_EQ(content_of(out / "program-kept-1.ngc"), "by hand");
    EXPECT_THAT(content_of(out / "program.ngc"), HasSubstr("G93"));
    const Ended second = plan(small_project(scratch.path(), "dome", "\"nu\": 20", "\"nu\": 7"));
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_THAT(second.err, Not(HasSubstr("kept"))) << "its own, which may be replaced";
    EXPECT_FALSE(fs::exists(out / "program-kept-2.ngc"));
    EXPECT_TRUE(drafts().empty());
}

TEST_F(KeptFiles, ACommandThatFailsMakesNoFileItsOwn) {
    const fs::path good = scratch / "good.ngc", bad = scratch / "bad.ngc", mine = scratch / "p.ngc";
    write_content(good, "G00 Z5\nG01 Z1 F100\nM02\n");
    write_content(bad, "G1 X10 F0\n");
    const auto convert = [&](const fs::path& from) {
        return run({"gcode", "convert", from, "--machine", "router-xyz", "--post", "grbl", "--out", mine});
    };
    write_content(mine, "my notes");
    EXPECT_EQ(convert(bad).exit_code, 1);
    EXPECT_EQ(content_of(mine), "my notes");
    EXPECT_FALSE(fs::exists(scratch / "p-kept-1.ngc"));
    EXPECT_THAT(convert(good).err,
                HasSubstr("was not written by Millwright; the old file is now p-kept-1.ngc"));
    EXPECT_EQ(content_of(scratch / "p-kept-1.ngc"), "my notes");
    write_content(mine, "edited"); // a program of ours that a person has changed
    EXPECT_EQ(convert(bad).exit_code, 1);
    EXPECT_THAT(convert(good).err,
                HasSubstr("was changed since Millwright wrote it; the changed file is now p-kept-2.ngc"));
    EXPECT_EQ(content_of(scratch / "p-kept-2.ngc"), "edited");
    EXPECT_EQ(convert(bad).exit_code, 1); // ours stays ours
    EXPECT_THAT(convert(good).err, Not(HasSubstr("kept")));
}

/// The contents of all files in `folder`, by name.
std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        found[entry.path().filename().string()] = content_of(entry.path());
    }
    return found;
}

/// The contents of all files in `folder`, those with a dot in front only where `hidden`.
std::vector<std::string> contents(const fs::path& folder, bool hidden) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (hidden || !entry.path().filename().string().starts_with('.')) {
            found.push_back(content_of(entry.path()));
        }
    }
    return found;
}

// The file of a person had a draft's name for a moment, and the next command removed it as an abandoned
// draft.
TEST_F(KeptFiles, AKillAtAnyMomentLosesNoFileThatAPersonHad) {
    const std::vector<std::string> words{"cordic", "rtl", "--out", out.string(), "--vectors", "2"};
    ASSERT_EQ(run(words).exit_code, 0);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(out)) {
        names.push_back(entry.path().filename().string());
    }
    ASSERT_GE(names.size(), 2U);
    constexpr int most = 100;
    int kills = 0;
    for (int n = 1; n < most; ++n) {
        fs::remove_all(out);
        fs::create_directory(out);
        for (const std::string& name : names) {
            write_content(out / name, name + " of a person");
        }
        const Ended ended = run_killed_at(n, words);
        if (ended.exit_code == 0) {
            break;
        }
        ASSERT_EQ(ended.exit_code, -SIGKILL) << ended.err;
        ++kills;
        for (const std::string& name : names) {
            EXPECT_THAT(contents(out, true), testing::Contains(name + " of a person")) << n;
        }
        ASSERT_EQ(run(words).exit_code, 0) << n;
        EXPECT_TRUE(drafts().empty()) << n;
        for (const std::string& name : names) {
            EXPECT_THAT(contents(out, false), testing::Contains(name + " of a person")) << n;
        }
    }
    EXPECT_GE(kills, 3 * static_cast<int>(names.size()));
    EXPECT_LT(kills, most - 1) << "the program comes to its end";
}

TEST_F(KeptFiles, AFileThatAnOptionNamesIsKeptTooUnlessACommandHasWrittenItLast) {
    const fs::path file = scratch / "in.ngc";
    const fs::path made = scratch / "made.ngc";
    write_content(file, "G21 G90 G17\nG1 X1 Y0 Z0 F100\nM2\n");
    write_content(made, "by hand");
    const std::vector<std::string> words{
        "gcode", "convert", file, "--machine", "router-xyz", "--post", "grbl", "--out", made};
    const Ended first = run(words);
    EXPECT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.err, HasSubstr("was not written by Millwright; the old file is now made-kept-1.ngc"));
    EXPECT_EQ(content_of(scratch / "made-kept-1.ngc"), "by hand");
    write_content(file, "G21 G90 G17\nG1 X2 Y0 Z0 F100\nM2\n");
    EXPECT_THAT(run(words).err, Not(HasSubstr("kept")));
    EXPECT_THAT(content_of(made), HasSubstr("X2"));
    const std::string before = content_of(made) + "(by hand)\n";
    write_content(made, before);
    write_content(file, "nonsense");
    EXPECT_NE(run(words).exit_code, 0);
    EXPECT_EQ(content_of(made), before);
    EXPECT_FALSE(fs::exists(scratch / "made-kept-2.ngc")) << "nothing was replaced";
}

TEST_F(KeptFiles, TwoAtOnceLeaveTheFilesOfOne) {
    const fs::path dome = small_project(scratch.path(), "dome");
    const fs::path bells = small_project(scratch.path(), "two-bell");
    for (const fs::path& project : {dome, bells}) { // what each writes alone
        ASSERT_EQ(run({"plan", project, "--out", scratch / project.stem()}).exit_code, 0);
    }
    for (int n = 0; n < 5; ++n) {
        Program first({"plan", dome, "--out", out});
        Program second({"plan", bells, "--out", out});
        EXPECT_EQ(first.end().exit_code, 0);
        EXPECT_EQ(second.end().exit_code, 0);
        const std::string program = content_of(out / "program.ngc");
        const bool of_dome = program == content_of(scratch / "dome" / "program.ngc");
        const fs::path whose = scratch / (of_dome ? "dome" : "two-bell");
        for (const char* const name : {"program.ngc", "report.json", "preview.png"}) {
            EXPECT_EQ(content_of(out / name), content_of(whose / name)) << name;
        }
        EXPECT_TRUE(drafts().empty());
    }
}

// One command's program was left with the other's report.
TEST_F(KeptFiles, TwoCommandsAtOnceLeaveTheFilesOfOne) {
    const fs::path dome = small_project(scratch.path(), "dome");
    const fs::path bells = small_project(scratch.path(), "two-bell");
    const auto planned = [&](const fs::path& folder) {
        return std::vector<std::string>{"plan", dome.string(), "--out", folder.string()};
    };
    const auto cut = [&](const fs::path& folder) {
        return std::vector<std::string>{"cutter",
                                        bells.string(),
                                        "--tool",
                                        "assets/tools/ball-6.json",
                                        "--allow-gouges",
                                        "--out",
                                        folder.string()};
    };
    ASSERT_EQ(run(planned(scratch / "plan")).exit_code, 0);
    ASSERT_EQ(run(cut(scratch / "cutter")).exit_code, 0);
    for (int n = 0; n < 3; ++n) {
        Program first(planned(out));
        Program second(cut(out));
        EXPECT_EQ(first.end().exit_code, 0);
        EXPECT_EQ(second.end().exit_code, 0);
        const std::string program = content_of(out / "program.ngc");
        const bool of_plan = program == content_of(scratch / "plan" / "program.ngc");
        EXPECT_EQ(files_of(out), files_of(scratch / (of_plan ? "plan" : "cutter"))) << n;
    }
}

TEST_F(KeptFiles, WhatNoLongerFitsAReplacedProgramIsTakenAway) {
    const fs::path dome = small_project(scratch.path(), "dome");
    const auto cut = [&](const fs::path& project) {
        return run({"cutter", project, "--tool", "assets/tools/ball-6.json", "--allow-gouges", "--out", out});
    };
    ASSERT_EQ(plan(dome).exit_code, 0);
    const Ended same = run({"plan", dome, "--post", "heidenhain", "--out", out});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_TRUE(fs::exists(out / "program.ngc")) << "the report of both programs is the same";
    const Ended other = cut(small_project(scratch.path(), "two-bell"));
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_THAT(
        other.err,
        AllOf(HasSubstr("report.json: was left by an earlier command"), HasSubstr("and was removed")));
    for (const char* const name : {"report.json", "preview.png", "program.h"}) {
        EXPECT_FALSE(fs::exists(out / name)) << name;
    }
    write_content(out / "cut.json", "by hand"); // no longer as it was written, and kept
    EXPECT_THAT(plan(dome).err,
                HasSubstr("was changed since Millwright wrote it; the changed file is now cut-kept-1.json"));
    EXPECT_EQ(content_of(out / "cut-kept-1.json"), "by hand");
    EXPECT_FALSE(fs::exists(out / "surface.csv"));
    EXPECT_TRUE(fs::exists(out / "preview.png"));
}

// Of a program that gouges there are the other files alone, and none of them is replaced.
TEST_F(KeptFiles, WhatIsLeftOfARefusedProgramIsTakenAwayByTheNextOne) {
    const fs::path dome = small_project(scratch.path(), "dome");
    const std::vector<std::string> cut{
        "cutter", dome.string(), "--tool", "assets/tools/ball-6.json", "--out", out.string()};
    constexpr int gouges = 3;
    ASSERT_EQ(run(cut).exit_code, gouges);
    ASSERT_TRUE(fs::exists(out / "cut.json"));
    ASSERT_FALSE(fs::exists(out / "program.ngc"));
    write_content(out / "notes.txt", "by hand");
    const Ended planned = plan(small_project(scratch.path(), "two-bell"));
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
    EXPECT_THAT(planned.err, HasSubstr("cut.json: was left by an earlier command"));
    for (const char* const name : {"cut.json", "surface.csv"}) {
        EXPECT_FALSE(fs::exists(out / name)) << name;
    }
    EXPECT_TRUE(fs::exists(out / "notes.txt"));
    ASSERT_EQ(run(cut).exit_code, gouges); // and the other way round
    for (const char* const name : {"report.json", "preview.png", "program.ngc"}) {
        EXPECT_FALSE(fs::exists(out / name)) << name;
    }
    EXPECT_TRUE(fs::exists(out / "surface.csv"));
}

TEST_F(KeptFiles, FilesThatDescribeTheSameProgramStayTogether) {
    auto project = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    project["tool"] = nlohmann::json::parse(content_of("assets/tools/ball-6.json")).at("tool");
    write_content(scratch / "ball.json", project.dump());
    ASSERT_EQ(run({"cutter", scratch / "ball.json", "--allow-gouges", "--out", out}).exit_code, 0);
    const Ended planned = run({"plan", scratch / "ball.json", "--allow-gouges", "--out", out});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
    for (const char* const name : {"program.ngc", "cut.json", "surface.csv", "report.json", "preview.png"}) {
        EXPECT_TRUE(fs::exists(out / name)) << name;
    }
    ASSERT_EQ(plan(small_project(scratch.path(), "two-bell")).exit_code, 0);
    EXPECT_FALSE(fs::exists(out / "cut.json")) << "of another program now";
}

TEST_F(KeptFiles, AllAreReplacedOrNone) {
    const fs::path project = small_project(scratch.path(), "dome");
    ASSERT_EQ(plan(project).exit_code, 0);
    const std::string before = content_of(out / "program.ngc");
    fs::permissions(out / "report.json", fs::perms(0444));
    const Ended ended = plan(small_project(scratch.path(), "dome", "\"nu\": 20", "\"nu\": 7"));
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("report.json: cannot write: the file is write-protected"));
    EXPECT_EQ(content_of(out / "program.ngc"), before);
    EXPECT_TRUE(drafts().empty());
}

// Before the work, whose progress is not printed then.
TEST_F(KeptFiles, WhatCannotBeWrittenIsFoundBeforeTheWork) {
    const fs::path project = small_project(scratch.path(), "dome");
    fs::create_directory(out);
    write_content(scratch / "file", "old");
    const std::vector<std::string> grid{"thesis", "grid", project, "--method", "elliptic"};
    for (const auto& [words, reason] : {
             std::pair(std::vector<std::string>{"--out", scratch / "no/grid.dat"},
                       "no/grid.dat: cannot write"),
             {{"--out", out}, "--out names a folder, but must name a file (add a file name)"},
             {{"--out", out / "a", "--norms", scratch / "no/n.csv"}, "no/n.csv: cannot write"},
             {{"--out", out / "a", "--residuals", out}, "--residuals names a folder, but must name a file"},
         }) {
        std::vector<std::string> all = grid;
        all.insert(all.end(), words.begin(), words.end());
        const Ended ended = run(all);
        EXPECT_EQ(ended.exit_code, 1) << reason;
        EXPECT_THAT(ended.err, AllOf(HasSubstr(reason), Not(HasSubstr(" % "))));
    }
    const Ended plan_in_file = run({"plan", project, "--out", scratch / "file"});
    EXPECT_EQ(plan_in_file.exit_code, 1);
    EXPECT_THAT(plan_in_file.err, HasSubstr("--out names a file, but must name a folder"));
    const Ended accepted = run({"study",
                                "set-up",
                                project,
                                "--out",
                                out,
                                "--places",
                                "2",
                                "--nodes",
                                "4",
                                "--accept",
                                scratch / "no/p.json"});
    EXPECT_THAT(accepted.err, AllOf(HasSubstr("no/p.json: cannot write"), Not(HasSubstr(" % "))));
    EXPECT_TRUE(fs::is_empty(out)) << "nothing is left of looking";
    EXPECT_EQ(content_of(scratch / "file"), "old");
}

TEST_F(KeptFiles, NoLinkIsFollowedThatSomebodyPutInTheWay) {
    const fs::path project = small_project(scratch.path(), "dome");
    fs::create_directory(out);
    write_content(scratch / "secret", "old");
    for (const char* const name : {".program.ngc.new", ".report.json.new", ".preview.png.new"}) {
        fs::create_symlink(scratch / "secret", out / name); // the names that drafts once had
    }
    EXPECT_EQ(plan(project).exit_code, 0);
    EXPECT_EQ(content_of(scratch / "secret"), "old");
}

TEST_F(KeptFiles, ReadersOfEndlessFilesEndAndSayTheirBound) {
    write_content(scratch / "sparse.plt", "");
    fs::resize_file(scratch / "sparse.plt", std::uintmax_t{4} << 30U);
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"plot", "info", "/dev/zero"},
             {"plot", "info", (scratch / "sparse.plt").string()},
             {"gcode", "check", (scratch / "sparse.plt").string()},
             {"plan", "/dev/zero", "--out", out.string()},
             {"gcode", "check", "/dev/zero"},
             {"picture", "relief", "/dev/zero", "--depth", "1", "--out", (scratch / "x.ngc").string()}}) {
        const Ended ended = run(words);
        EXPECT_NE(ended.exit_code, 0) << words[0];
        EXPECT_THAT(ended.err,
                    AllOf(AnyOf(HasSubstr(" GiB"), HasSubstr(" MiB")), Not(HasSubstr("internal error"))))
            << words[0] << " " << words[1];
    }
}

TEST_F(KeptFiles, StrangePathsAreErrorsAndNoInternalOnes) {
    fs::create_symlink("b", scratch / "a");
    fs::create_symlink("a", scratch / "b");
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"plan", (scratch / "a").string(), "--out", out.string()},
             {"gcode", "check", (scratch / "a").string()},
             {"plan", "assets/projects/dome.json", "--out", (scratch / "a").string()},
             {"jobs", (scratch / "a").string()}}) {
        const Ended ended = run(words);
        EXPECT_THAT(ended.err, Not(HasSubstr("internal error"))) << words[0] << ": " << ended.err;
    }
    const Ended gone = Program({"machine", "bodies", "x"},
                               {},
                               {"sh",
                                "-c",
                                "mkdir " + (scratch / "gone").string() + " && cd " +
                                    (scratch / "gone").string() + " && rmdir ../gone && \"$0\" \"$@\""})
                           .end();
    EXPECT_NE(gone.exit_code, 0);
    EXPECT_THAT(gone.err, Not(HasSubstr("internal error"))) << gone.err;
}

TEST_F(KeptFiles, AProgramOfTheLongestNameIsRunAndLogged) {
    const fs::path file = scratch / (std::string(250, 'n') + ".ngc");
    write_content(file, "G21 G90 F3000\nG1 X1\nM30\n");
    const Ended ended = sent(file);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(logs), {}), 1);
}

TEST_F(KeptFiles, JobsPrintNoControlCharacters) {
    const fs::path file = scratch / "a\x1b[31m\x07.ngc";
    write_content(file, "G21 G90 F3000\nG1 X1\nG1 X999999\nM30\n");
    (void)sent(file);
    write_content(file, "G21 G90 F3000\nG1 X1\nM30\n");
    (void)sent(file);
    const Ended ended = run({"jobs", logs});
    EXPECT_THAT(ended.out, HasSubstr("\\x1b[31m\\x07"));
    EXPECT_THAT(ended.out, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07"))));
}

TEST_F(KeptFiles, WithoutAHomeTheSystemKnowsWhereLogsGo) {
    const Ended ended = Program({"send", "--help"}, {}, {"env", "-u", "HOME", "-u", "XDG_STATE_HOME"}).end();
    EXPECT_THAT(ended.out, HasSubstr(".local/state/millwright/jobs"));
}

} // namespace
} // namespace millwright::test
