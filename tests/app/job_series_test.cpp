// Several jobs in one command.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <set>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

struct Series : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "grbl").string();
    std::string logs = (scratch / "logs").string();
    std::string a = file("a", 30), b = file("b", 30), c = file("c", 30);

    [[nodiscard]] std::string file(const std::string& name, int lines) const {
        std::string text = "G21 G90 G94 S1000 M3\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F3000\n";
        for (int n = 0; n < lines; ++n) {
            text += "X" + std::to_string(n % 2 == 0 ? 10 : 0) + " Y" + std::to_string(n % 150) + "\n";
        }
        const fs::path path = scratch / (name + ".ngc");
        write_content(path, text + "M30\n");
        return path.string();
    }
    [[nodiscard]] Ended send(std::vector<std::string> more, const std::string& input = {}) const {
        std::vector<std::string> words = {
            "send", "--driver", "grbl", "--port", port, "--log", logs, "--unlock"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words, input);
    }
    /// One job held and one waiting, as docs/reference/job-log.md shows them: member by member.
    void expect_documented_queue() const {
        const std::string page = content_of("docs/reference/job-log.md");
        const auto begin = page.find("```json\n", page.find("## A queue of jobs"));
        ASSERT_NE(begin, std::string::npos);
        const auto from = page.find('{', begin);
        const auto shown = nlohmann::json::parse(page.substr(from, page.find("```", from) - from));
        const auto written = nlohmann::json::parse(content_of(logs + "/queue.json"));
        const auto names = [](const nlohmann::json& object) {
            std::set<std::string> found;
            for (const auto& [name, value] : object.items()) {
                found.insert(name);
            }
            return found;
        };
        EXPECT_EQ(names(written), names(shown));
        ASSERT_EQ(shown.at("jobs").size(), 2U);
        for (std::size_t n = 0; n < 2; ++n) {
            EXPECT_EQ(names(written.at("jobs")[n]), names(shown.at("jobs")[n])) << n;
            EXPECT_EQ(written.at("jobs")[n].at("state"), shown.at("jobs")[n].at("state"));
        }
    }
    /// File names and states of the queue on disk.
    [[nodiscard]] std::string queue() const {
        std::string text;
        const auto whole = nlohmann::json::parse(content_of(logs + "/queue.json"));
        for (const auto& job : whole.at("jobs")) {
            text += job.at("job").get<std::string>() + " " + job.at("state").get<std::string>() + " ";
        }
        return text;
    }
};

TEST_F(Series, EachJobButTheFirstBeginsWhenAPersonSaysSo) {
    Emulator emulator(port, {"--speed", "50"});
    Ended ended = send({a, b, c}, "y\nlater\n");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("Next: " + b + ", 35 blocks"));
    EXPECT_THAT(ended.out, HasSubstr("1 job left in " + logs + "/queue.json"));
    EXPECT_EQ(queue(), "a done b done c waiting ");
    ended = send({a, b});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("1 job of an earlier command"));
    ended = send({"--continue"}, "y\n");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("All 35 blocks were executed"));
    EXPECT_EQ(queue(), "");
    EXPECT_EQ(send({"--continue"}).exit_code, 1);
}

TEST_F(Series, NobodyIsAskedWhereThatIsWanted) {
    Emulator emulator(port, {"--speed", "50"});
    const Ended ended = send({a, b, "--yes"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, Not(HasSubstr("Next:")));
    EXPECT_TRUE(fs::exists(logs + "/b-0001.jsonl"));
}

TEST_F(Series, OfOneFileAloneIsNothingToContinueAndTheLogIsNamed) {
    const Ended ended = send({"--continue"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("millwright jobs " + logs));
}

TEST_F(Series, AFaultHoldsWhatFollows) {
    a = file("a", 500);
    {
        Emulator emulator(port, {"--speed", "20", "--faults", "alarm=4000"});
        const Ended ended = send({a, b, "--yes"});
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.out, HasSubstr("2 jobs left"));
        EXPECT_FALSE(fs::exists(logs + "/b-0001.jsonl"));
        (void)emulator.stop();
    }
    EXPECT_EQ(queue(), "a held b waiting ");
    expect_documented_queue();
    Emulator emulator(port, {"--speed", "50"});
    Ended ended = send({"--continue", "--yes"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("did not finish: Fault: "));
    EXPECT_THAT(run({"jobs", logs}).out,
                AnyOf(HasSubstr("send " + a + " --driver grbl --port " + port + " --from-line "),
                      HasSubstr("from the beginning")));
    ended = send({"--continue"}, "20\n"); // it was switched on anew: the tool's position is unknown
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("Line 20 could start at the wrong position"));
    EXPECT_FALSE(fs::exists(logs + "/a-0002.jsonl"));
    // Line 5 cannot be begun; from line 20, then the other.
    ended = send({"--continue", "--trust-position"}, "5\n20\ny\n");
    EXPECT_THAT(ended.out, HasSubstr("a limit switch was triggered")) << "what ended it is still known";
    EXPECT_THAT(ended.out,
                AnyOf(HasSubstr("Resumes at line "), HasSubstr("only restart from the beginning")));
    EXPECT_THAT(ended.out, HasSubstr(logs + "/a-0001.jsonl"));
    EXPECT_THAT(ended.out, HasSubstr("approach to this line needs 6 lines"));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(logs + "/a-0002.jsonl"), HasSubstr(R"("from_line":20)"));
    EXPECT_TRUE(fs::exists(logs + "/b-0001.jsonl"));
}

TEST_F(Series, AnythingWrongInAnyProgramIsSaidBeforeTheFirstBegins) {
    Emulator emulator(port, {"--speed", "50"});
    write_content(b, "G0 X1 ?\n");
    Ended ended = send({a, b, "--yes"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("b.ngc:1:7"));
    EXPECT_FALSE(fs::exists(logs + "/a-0001.jsonl"));
    write_content(b, "G21 G90 G0 X1\nX2000\nM2\n"); // beyond the travel of the machine that is there
    ended = send({a, b, "--yes"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("b.ngc:2"));
    EXPECT_FALSE(fs::exists(logs + "/a-0001.jsonl"));
    EXPECT_EQ(queue(), "") << "nothing has begun, so nothing is left";
    EXPECT_EQ(send({}).exit_code, 2);
    EXPECT_EQ(send({a, "--continue"}).exit_code, 2);
}

TEST_F(Series, AnotherProgramThanTheOneThatWasQueuedIsRefused) {
    Emulator emulator(port, {"--speed", "50"});
    EXPECT_EQ(send({a, b}, "no\n").exit_code, 1);
    write_content(b, "G0 X1\nM2\n");
    const Ended ended = send({"--continue"}, "y\n");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("b is not the program that was queued"));
}

TEST_F(Series, AProgramThatCannotBeHadAgainIsLeftOutIfAPersonSaysSo) {
    Emulator emulator(port, {"--speed", "50"});
    EXPECT_EQ(send({a, b, c}, "no\n").exit_code, 1);
    EXPECT_EQ(queue(), "a done b waiting c waiting ");
    fs::remove(b);
    Ended ended = send({"--continue"}, "later\n");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("b.ngc"));
    EXPECT_EQ(queue(), "a done b waiting c waiting ");
    ended = send({"--continue", "--yes"}, "s\n"); // no question is asked
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("b.ngc"));
    ended = send({"--continue"}, "s\ny\n");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(b + " cannot continue: "));
    EXPECT_FALSE(fs::exists(logs + "/b-0001.jsonl"));
    EXPECT_TRUE(fs::exists(logs + "/c-0001.jsonl"));
}

TEST_F(Series, ProjectsFollowEachOtherOnOneMachine) {
    const fs::path project = small_project(scratch.path(), "two-bell");
    const Ended ended =
        run({"run", project, project, "--driver", "virtual", "--speed", "0", "--log", logs, "--yes"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(fs::exists(logs + "/two-bell-0002.jsonl"));
}

} // namespace
} // namespace millwright::test
