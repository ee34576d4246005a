// What becomes of a job whose log cannot be written any more.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/recovery.h"
#include "tests/support/jobs.h"
#include "tests/support/small_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

namespace millwright::jobs {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

/// A job whose disk is full after a while.
struct FullDiskBench {
    test::TemporaryFolder folder;
    std::filesystem::path logs = folder.path() / "logs";
    std::filesystem::path log = logs / "test-0001.jsonl";
    test::ManualClock clock;
    Job job = test::dome_job();
    drivers::VirtualMachine machine{job.program->start, {}, clock};
    Dispatcher dispatcher{machine, clock, logs};

    /// What the dispatcher says of it.
    [[nodiscard]] std::string said(const std::function<void()>& fill) {
        constexpr int full_at = 300;
        int looks = 0;
        try {
            (void)dispatcher.run(job, {}, [&](const JobReport&) {
                if (++looks == full_at) {
                    fill();
                }
            });
        } catch (const Error& error) {
            return error.what();
        }
        return "it ran";
    }
};

TEST(FullDisk, StopsTheMachineAndSaysWhereInItsLogToo) {
    FullDiskBench bench;
    const test::SmallDisk disk(bench.logs);
    if (!disk.mounted()) {
        GTEST_SKIP() << "needs the right to mount";
    }
    const std::string said = bench.said([&] { disk.fill(); });
    const std::string where = "the job was stopped at block [0-9]+ of " +
                              std::to_string(bench.job.block_count()) +
                              " because its log cannot be written: No space left on device; [0-9]+ of [0-9]+ "
                              "blocks were confirmed as executed";
    EXPECT_THAT(said, MatchesRegex(".*test-0001.jsonl: " + where + " \\(.*\\)"));
    EXPECT_EQ(bench.machine.status().state, drivers::DriverState::stopped);
    const ReadLog log = read_job_log(bench.log);
    EXPECT_FALSE(log.torn);
    EXPECT_EQ(log.end(), JobEnd::fault);
    EXPECT_EQ(log.executed_blocks(), bench.machine.status().executed_blocks);
    EXPECT_LT(log.executed_blocks(), bench.job.block_count());
    EXPECT_THAT(job_story(bench.log).sentence, MatchesRegex("fault after .*: " + where + "\\."));
}

TEST(FullDisk, NoLogIsLeftOfAJobThatCouldNotBegin) {
    FullDiskBench bench;
    const test::SmallDisk disk(bench.logs);
    if (!disk.mounted()) {
        GTEST_SKIP() << "needs the right to mount";
    }
    disk.fill();
    EXPECT_THAT(bench.said([] {}), HasSubstr("cannot write the job log: No space left on device"));
    EXPECT_FALSE(std::filesystem::exists(bench.log));
    EXPECT_EQ(bench.machine.status().executed_blocks, 0);
}

TEST(FullDisk, RoomThatWasKeptIsGivenBack) {
    test::TemporaryFolder folder;
    const test::SmallDisk disk(folder.path() / "disk");
    if (!disk.mounted()) {
        GTEST_SKIP() << "needs the right to mount";
    }
    const auto free = [&] { return std::filesystem::space(folder.path() / "disk").free; };
    const auto before = free();
    {
        JobLog log(folder.path() / "disk", "test");
        log.write(LogStart{});
        EXPECT_LE(free(), before - 8192);
    }
    EXPECT_GE(free(), before - 4096);
}

// No room can be kept against a limit of the process, so the log has no end, and claims no less than was done
// when it was written last.
TEST(FullDisk, StopsTheMachineWhereNoRoomWasKept) {
    FullDiskBench bench;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const std::string said = bench.said([&] {
        rlimit none = before;
        none.rlim_cur = 0;
        (void)::setrlimit(RLIMIT_FSIZE, &none);
    });
    (void)::setrlimit(RLIMIT_FSIZE, &before);
    (void)std::signal(SIGXFSZ, handler);
    EXPECT_THAT(said, HasSubstr("because its log cannot be written: File too large"));
    EXPECT_EQ(bench.machine.status().state, drivers::DriverState::stopped);
    const ReadLog log = read_job_log(bench.log);
    EXPECT_FALSE(log.torn);
    EXPECT_FALSE(log.end());
    EXPECT_TRUE(job_story(bench.log).broken_off());
}

} // namespace
} // namespace millwright::jobs
