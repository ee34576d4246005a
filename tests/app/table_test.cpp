// A project on a table at the other end of a pseudo-terminal, both of them the real program.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <thread>

namespace millwright::test {
namespace {

using testing::HasSubstr;

void wait_for(const std::filesystem::path& link) {
    for (int n = 0; n < 30'000 && !std::filesystem::exists(link); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(TableCommand, RefusedRecordEndsTheJobAndTheLogSaysHowFar) {
    const ScratchFolder folder;
    const std::string port = (folder / "table").string();
    Program table(
        {"emulate", "table", "--pty", port, "--machine", "router-xyz", "--answer", "ok", "--refuse", "50"});
    wait_for(port);
    const Ended ended = run({"run",
                             small_project(folder.path(), "router-dome").string(),
                             "--driver",
                             "stream",
                             "--port",
                             port,
                             "--record",
                             "t {X} {Y} {Z} {a} {s}",
                             "--answer",
                             "ok",
                             "--log",
                             (folder / "jobs").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out + ended.err, HasSubstr("the machine answered 'error' to record 50"));
    table.send(SIGINT);
    EXPECT_THAT(table.end().out, HasSubstr("49 records obeyed, 0 lines that were none"));
}

TEST(TableCommand, WrongRecordsAreRefused) {
    const ScratchFolder folder;
    const Ended ended = run({"run",
                             small_project(folder.path(), "router-dome").string(),
                             "--driver",
                             "stream",
                             "--port",
                             "file:" + (folder / "out").string(),
                             "--record",
                             "t {X} {Q}"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the record 't {X} {Q}': there is no 'Q'"));
}

} // namespace
} // namespace millwright::test
