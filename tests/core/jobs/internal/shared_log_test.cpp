#include "core/base/error.h"
#include "core/jobs/internal/running_job.h"
#include "tests/support/jobs.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <thread>

namespace millwright::jobs::internal {
namespace {

constexpr int logged_blocks = 100'000;

struct SharedLogBench {
    test::TemporaryFolder folder;
    test::ManualClock clock;
    JobLog file{folder.path(), "job"};
    LogRecord before;
    std::unique_ptr<SharedLog> log;

    SharedLogBench() {
        LogStart start;
        start.axes = {{'X', kinematics::AxisKind::linear}};
        start.blocks = logged_blocks;
        file.write(start);
        before.position = kinematics::AxisPositions::Zero(1);
        log = std::make_unique<SharedLog>(file, clock, clock.now(), logged_blocks, before);
    }
    [[nodiscard]] ReadLog read() const { return read_job_log(file.file()); }
};

TEST(SharedLog, AllowsASlowStreamBlockByBlock) {
    SharedLogBench bench;
    EXPECT_EQ(bench.log->allow(1), 1);
    for (int sent = 1; sent < 50; ++sent) {
        bench.clock.wait(0.2);
        EXPECT_EQ(bench.log->allow(sent + 1), sent + 1);
    }
    EXPECT_EQ(bench.read().allowed_blocks(), 50);
}

TEST(SharedLog, AllowsAFastStreamWhatItSendsInAFiftiethOfASecond) {
    SharedLogBench bench;
    int allowed = 0;
    for (int sent = 0; sent < 10'000; ++sent) {
        if (sent == allowed) {
            allowed = bench.log->allow(sent + 1);
            ASSERT_GT(allowed, sent);
            EXPECT_LE(allowed - sent, 32) << sent;
        }
        if (sent % 500 == 0) {
            EXPECT_GT(bench.read().allowed_blocks(), sent);
        }
        bench.clock.wait(0.001);
    }
    EXPECT_LE(bench.read().records.size(), 10'000U / 15U); // and not a line for each of 10,000
}

TEST(SharedLog, NeverAllowsMoreThanThereIs) {
    SharedLogBench bench;
    EXPECT_EQ(bench.log->allow(logged_blocks), logged_blocks);
    EXPECT_EQ(bench.read().allowed_blocks(), logged_blocks);
    EXPECT_EQ(bench.log->allow(1), logged_blocks); // what is allowed stays so
}

TEST(SharedLog, SaysInEachLineWhatWasExecutedBefore) {
    SharedLogBench bench;
    LogRecord executed = bench.before;
    executed.executed_blocks = 7;
    executed.line = 9;
    executed.position[0] = 3.0;
    executed.position_doubt = "it was stopped while it moved";
    bench.log->write(executed);
    (void)bench.log->allow(20);
    const LogRecord last = bench.read().records.back();
    EXPECT_EQ(last.position_doubt, executed.position_doubt);
    EXPECT_EQ(last.event, LogEvent::ahead);
    EXPECT_EQ(last.executed_blocks, 7);
    EXPECT_EQ(last.line, 9);
    EXPECT_EQ(last.position[0], 3.0);
}

TEST(SharedLog, AllowsNothingMoreOnceItIsClosed) {
    SharedLogBench bench;
    EXPECT_EQ(bench.log->allow(3), 3);
    bench.log->close();
    EXPECT_EQ(bench.log->allow(4), 3);
    EXPECT_EQ(bench.read().allowed_blocks(), 3);
}

/// No file of this process grows while it lives.
class FullDisk {
public:
    FullDisk() : action_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit none = before_;
        none.rlim_cur = 0;
        ::setrlimit(RLIMIT_FSIZE, &none);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, action_);
    }

private:
    rlimit before_{};
    void (*action_)(int);
};

TEST(SharedLog, AllowsNothingThatItCannotWriteDown) {
    SharedLogBench bench;
    EXPECT_EQ(bench.log->allow(3), 3);
    {
        const FullDisk full;
        EXPECT_EQ(bench.log->allow(4), 3);
    }
    EXPECT_EQ(bench.log->allow(5), 3); // nor later
    EXPECT_THROW(bench.log->rethrow_failure(), Error);
}

TEST(SharedLog, IsWrittenByTwoThreadsLineByLine) {
    SharedLogBench bench;
    std::jthread driver([&] {
        for (int n = 1; n <= 2000; ++n) {
            (void)bench.log->allow(50 * n);
        }
    });
    LogRecord executed = bench.before;
    for (int n = 1; n <= 2000; ++n) {
        executed.executed_blocks = n;
        bench.log->write(executed);
    }
    driver.join();
    const ReadLog read = bench.read(); // throws for an invalid line
    EXPECT_EQ(std::ranges::count(read.records, LogEvent::executed, &LogRecord::event), 2000);
    EXPECT_EQ(read.allowed_blocks(), logged_blocks);
    EXPECT_TRUE(std::ranges::is_sorted(read.records, {}, &LogRecord::executed_blocks));
}

} // namespace
} // namespace millwright::jobs::internal
