#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sstream>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The lines of the only log in `folder`.
std::vector<nlohmann::json> only_log_in(const fs::path& folder) {
    std::vector<nlohmann::json> lines;
    int logs = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        ++logs;
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            lines.push_back(nlohmann::json::parse(line));
        }
    }
    EXPECT_EQ(logs, 1);
    return lines;
}

TEST(RunCommand, RunsTheWholeProgramAndLogsIt) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "two-bell");
    const Ended ended =
        run({"run", project, "--driver", "virtual", "--speed", "1000", "--log", (scratch / "logs").string()});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("blocks were executed"));
    EXPECT_THAT(ended.out, HasSubstr((scratch / "logs").string()));
    EXPECT_THAT(ended.err, HasSubstr(" %  Block "));
    const auto log = only_log_in(scratch / "logs");
    ASSERT_GE(log.size(), 3u);
    EXPECT_EQ(log.back().at("record"), "end");
    EXPECT_EQ(log.back().at("executed_blocks"), log.front().at("blocks"));
}

TEST(RunCommand, RunsNoProgramThatGougesThePart) {
    const ScratchFolder scratch;
    auto json = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    json["tool"] = {{"cutter", "ball"}, {"diameter_mm", 6}};
    const fs::path project = scratch / "ball.json";
    write_content(project, json.dump());
    std::vector<std::string> command{
        "run", project, "--driver", "virtual", "--speed", "1000", "--log", (scratch / "logs").string()};
    const Ended refused = run(command);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("nothing was run"));
    EXPECT_FALSE(fs::exists(scratch / "logs") && !fs::is_empty(scratch / "logs"));
    command.emplace_back("--allow-gouges");
    const Ended allowed = run(command);
    EXPECT_EQ(allowed.exit_code, 0) << allowed.err;
    EXPECT_THAT(allowed.err, HasSubstr("warning: the cutter goes up to"));
}

TEST(RunCommand, DispatchesToTheCordicProcessorWhatItCanDo) {
    const ScratchFolder scratch;
    const auto logs = (scratch / "logs").string();
    const Ended ended = run({"run",
                             small_project(scratch.path(), "router-dome"),
                             "--driver",
                             "cordic",
                             "--speed",
                             "0",
                             "--log",
                             logs});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("blocks were executed"));
    const auto log = only_log_in(scratch / "logs");
    EXPECT_EQ(log.front().at("driver"), "cordic");
    EXPECT_EQ(log.back().at("executed_blocks"), log.front().at("blocks"));
    const Ended refused =
        run({"run", small_project(scratch.path(), "dome"), "--driver", "cordic", "--log", logs});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("the CORDIC processor has no axis "));
}

TEST(RunCommand, CtrlCBrakesTheMachineFirst) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    Program program(
        {"run", project, "--driver", "virtual", "--speed", "1", "--log", (scratch / "logs").string()});
    program.wait_for_error_text("Block ");
    program.send(SIGINT);
    const Ended ended = program.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("millwright: cancelled\n"));
    const auto log = only_log_in(scratch / "logs");
    ASSERT_GE(log.size(), 2u);
    EXPECT_EQ(log.back().at("record"), "end");
    EXPECT_LT(log.back().at("executed_blocks"), log.front().at("blocks"));
}

TEST(RunCommand, WithoutALogNothingRuns) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    const Ended ended = run({"run",
                             project,
                             "--driver",
                             "virtual",
                             "--speed",
                             "1000",
                             "--log",
                             (scratch / "dome.json/logs").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("dome.json/logs"));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("blocks were executed")));
}

} // namespace
} // namespace millwright::test
