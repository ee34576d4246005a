// A study on several ranks of a real mpirun.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

namespace millwright::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> study(const std::string& out) {
    return {"study", "kinematic-error", "--quick", "--surface", "dome", "--out", out};
}

const std::vector<std::string> two_ranks{"mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2"};

/// The process that mpirun made rank `rank`; 0 if there is none.
pid_t process_of_rank(pid_t mpirun, int rank) {
    const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    std::istringstream children(
        content_of("/proc/" + std::to_string(mpirun) + "/task/" + std::to_string(mpirun) + "/children"));
    for (pid_t child = 0; children >> child;) {
        std::istringstream environment(content_of("/proc/" + std::to_string(child) + "/environ"));
        for (std::string entry; std::getline(environment, entry, '\0');) {
            if (entry == wanted) {
                return child;
            }
        }
    }
    return 0;
}

/// kill -9, of a process that nothing can prepare for it.
void kill_rank(const Program& program, int rank) {
    const pid_t lost = process_of_rank(program.pid(), rank);
    ASSERT_GT(lost, 0);
    ::kill(lost, SIGKILL);
}

class StudyOnRanks : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::system("mpirun --version > /dev/null 2>&1") != 0) {
            GTEST_SKIP() << "Open MPI's mpirun is not installed";
        }
    }

    ScratchFolder folder_;
};

TEST_F(StudyOnRanks, ResultsAreThoseOfOneProcess) {
    const auto two_cases = [&](const std::string& out) {
        std::vector<std::string> words = study(folder_ / out);
        words.insert(words.end(), {"--surface", "sine", "--machine", "ca-head"}); // beside the dome
        return words;
    };
    const Ended alone = run(two_cases("one"));
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const Ended both = Program(two_cases("two"), {}, two_ranks).end();
    ASSERT_EQ(both.exit_code, 0) << both.err;
    for (const char* name : {"kinematic-error.csv", "kinematic-error.json", "kinematic-error.md"}) {
        EXPECT_EQ(content_of(folder_ / "one" / name), content_of(folder_ / "two" / name)) << name;
    }
    EXPECT_EQ(alone.out, both.out);
    EXPECT_THAT(both.err, HasSubstr("2 cases on 2 ranks"));
}

TEST_F(StudyOnRanks, CasesOfALostRankAreNamedAndAnEarlierStudyStays) {
    std::filesystem::create_directories(folder_ / "out");
    write_content(folder_ / "out" / "kinematic-error.csv", "an earlier study");
    Program program(
        {"study", "kinematic-error", "--surface", "dome", "--out", folder_ / "out"}, {}, two_ranks);
    program.wait_for_error_text("cases on 2 ranks");
    kill_rank(program, 1);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_THAT(
        ended.err,
        HasSubstr("rank 1 has not ended; missing cases: dome on rotary-tilt-listing with 20 points, "));
    EXPECT_THAT(ended.err, AllOf(HasSubstr("0 of 15 cases"), HasSubstr("nothing is written")));
    EXPECT_EQ(content_of(folder_ / "out" / "kinematic-error.csv"), "an earlier study");
}

TEST_F(StudyOnRanks, TheOthersNameTheirCasesWhenRank0IsLost) {
    Program program(
        {"study", "kinematic-error", "--surface", "dome", "--out", folder_ / "out"}, {}, two_ranks);
    program.wait_for_error_text("cases on 2 ranks");
    kill_rank(program, 0);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_THAT(
        ended.err,
        AllOf(HasSubstr("rank 1 was stopped and rank 0 does not respond; missing cases: dome on "
                        "rotary-tilt-listing with 20 points (begun), dome on rotary-tilt-listing with "
                        "40 points, "),
              HasSubstr("no case that rank 1 can see was written to " +
                        (folder_ / "out" / "unfinished").string())));
}

TEST_F(StudyOnRanks, CasesThatAreDoneOutliveRank0) {
    std::vector<std::string> words = study(folder_ / "out"); // the second of the machines is done first
    words.insert(words.end(), {"--machine", "rotary-tilt-listing", "--machine", "ca-head"});
    Program program(words, {}, two_ranks);
    program.wait_for_error_text("cases on 2 ranks");
    const auto unfinished = folder_ / "out" / "unfinished";
    while (!std::filesystem::exists(unfinished / "missing.txt") && process_of_rank(program.pid(), 0) > 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill_rank(program, 0);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_EQ(content_of(unfinished / "missing.txt"),
              "not in these tables: 1 of 2 cases\ndome on rotary-tilt-listing with 12 points\n");
    EXPECT_THAT(content_of(unfinished / "kinematic-error.csv"), HasSubstr("\ndome,ca-head,12,"));
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("the finished cases are in " + unfinished.string() +
                                ", whose missing.txt names the others\n"),
                      HasSubstr("its last finished case may not be written: dome on ca-head with 12 points"),
                      Not(HasSubstr("missing cases"))));
}

TEST_F(StudyOnRanks, AFolderThatCannotBeMadeEndsAllOfThem) {
    const Ended none =
        Program({"study", "kinematic-error", "--out", "/proc/no-such-folder"}, {}, two_ranks).end();
    EXPECT_NE(none.exit_code, 0);
    EXPECT_THAT(none.err, HasSubstr("/proc/no-such-folder"));
}

std::vector<std::string> set_up(const std::string& out, const std::string& places) {
    return {
        "study", "set-up", "assets/projects/dome.json", "--out", out, "--places", places, "--nodes", "12"};
}

TEST_F(StudyOnRanks, ASetUpSearchFindsWhatOneProcessFinds) {
    const Ended alone = run(set_up(folder_ / "one", "9"));
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const Ended both = Program(set_up(folder_ / "two", "9"), {}, two_ranks).end();
    ASSERT_EQ(both.exit_code, 0) << both.err;
    EXPECT_EQ(alone.out, both.out);
    for (const char* name : {"set-up.csv", "set-up.png"}) {
        EXPECT_EQ(content_of(folder_ / "one" / name), content_of(folder_ / "two" / name)) << name;
    }
    EXPECT_THAT(both.err, HasSubstr("81 positions on 2 ranks"));
}

TEST_F(StudyOnRanks, PlacesOfALostRankAreNamed) {
    Program program(set_up(folder_ / "out", "300"), {}, two_ranks);
    program.wait_for_error_text("90000 positions on 2 ranks");
    kill_rank(program, 1);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_THAT(ended.err, HasSubstr("rank 1 has not ended; "));
    EXPECT_THAT(ended.err, HasSubstr(" of its positions are missing: from ("));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "set-up.csv"));
}

TEST_F(StudyOnRanks, PlacesAreNamedWhenRank0IsLost) {
    Program program(set_up(folder_ / "out", "300"), {}, two_ranks);
    program.wait_for_error_text("50 %  90000 positions on 2 ranks"); // before, the other may not know of them
    kill_rank(program, 0);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("rank 1 was stopped and rank 0 does not respond; "),
                      HasSubstr(" of its positions are missing: from ("),
                      HasSubstr("; nothing is written\n")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "set-up.csv"));
}

// No place was named: this rank had measured all of its own.
TEST_F(StudyOnRanks, PlacesAreNamedWhenRank0IsLostOnItsWayDownhill) {
    std::vector<std::string> words = set_up(folder_ / "out", "9");
    words.back() = "60"; // nodes: each step of the way takes its time
    Program program(words, {}, two_ranks);
    program.wait_for_error_text("Descending from the best position");
    kill_rank(program, 0);
    const Ended ended = program.end();
    EXPECT_NE(ended.exit_code, 0);
    EXPECT_THAT(
        ended.err,
        AllOf(HasSubstr("rank 1 was stopped and rank 0 does not respond; it had measured all of its "),
              HasSubstr(" positions, which are lost with rank 0, as is what rank 0 computes alone after "
                        "them: from ("),
              HasSubstr("; nothing is written\n")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "set-up.csv"));
}

TEST_F(StudyOnRanks, WhatIsWrongEndsAllOfThem) {
    const Ended none = Program(set_up("/proc/no-such-folder", "9"), {}, two_ranks).end();
    EXPECT_NE(none.exit_code, 0);
    EXPECT_THAT(none.err, HasSubstr("/proc/no-such-folder"));
}

} // namespace
} // namespace millwright::test
