// Points through the driver, the dispatcher and a job log, in real time.
#include "core/drivers/points/points_driver.h"

#include "core/base/files.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job_log.h"
#include "core/jobs/point_job.h"
#include "core/jobs/recovery.h"
#include "core/links/file_link.h"
#include "tests/support/jobs.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace millwright::drivers {
namespace {

using testing::HasSubstr;

/// A line with tool 1 and another with tool 2, of 5 mm each, or one alone.
jobs::Job lines(int tools) {
    plot::Strokes strokes;
    plot::CutSettings settings;
    for (int tool = 1; tool <= tools; ++tool) {
        strokes.push_back({.pen = tool, .points = {{5.0, 5.0 * tool}, {10.0, 5.0 * tool}}});
        settings.levels.push_back({.pen = tool, .order = tool, .depth = 1.0, .tool = tool});
    }
    const auto model = std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
    return jobs::path_points_job(
        plot::cut_path(strokes, settings),
        "lines.plt",
        model,
        {.decoding = {.velocity = 2.0, .period = 0.1, .mode = plot::DecodeMode::path},
         .spindle_rpm = 8000.0});
}

struct PointsBench {
    explicit PointsBench(jobs::Job its_job, double speed = 100.0)
        : job(std::move(its_job)), driver(std::make_unique<links::FileLink>(folder.path() / "sent"),
                                          clock,
                                          job.machine,
                                          job.points->points.front(),
                                          {.speed = speed, .format = {.pattern = "{X},{Y},{Z}"}}) {}

    [[nodiscard]] std::vector<std::string> sent() {
        driver.close();
        std::vector<std::string> records;
        std::string text = read_file(folder.path() / "sent");
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            records.push_back(text.substr(at, end - at));
            at = end + 1;
        }
        return records;
    }

    test::TemporaryFolder folder;
    SteadyClock clock;
    jobs::Job job;
    PointsDriver driver;
    jobs::Dispatcher dispatcher{driver, clock, folder.path() / "logs"};
};

TEST(PointsDriver, PlaysAJobToItsEndAndItsLogHasIt) {
    PointsBench bench(lines(1));
    const jobs::JobOutcome outcome = bench.dispatcher.run(bench.job, {});
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, bench.job.block_count());
    // A file answers nothing.
    EXPECT_THAT(outcome.sentence, HasSubstr(" blocks were sent in "));
    EXPECT_THAT(outcome.sentence, testing::Not(HasSubstr("were executed")));
    const std::string text = read_file(outcome.log_file);
    EXPECT_THAT(text, HasSubstr("\"record\":\"sent\""));
    EXPECT_THAT(text, testing::Not(testing::AnyOf(HasSubstr("executed_blocks"), HasSubstr("\"executed\""))));
    EXPECT_THAT(jobs::job_story(outcome.log_file).sentence, HasSubstr("blocks were sent."));
    const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
    EXPECT_FALSE(log.start.answers);
    EXPECT_EQ(log.start.driver, "points");
    EXPECT_EQ(log.start.address, "file:" + (bench.folder.path() / "sent").string());
    EXPECT_EQ(log.start.blocks, bench.job.block_count());
    EXPECT_NEAR(log.start.planned_time, bench.job.points->duration(), 1e-9);
    EXPECT_EQ(log.end(), jobs::JobEnd::done);
    EXPECT_TRUE(std::ranges::is_sorted(log.records, {}, &jobs::LogRecord::executed_blocks));
    const auto sent = bench.sent();
    EXPECT_EQ(sent.size(), bench.job.points->points.size());
    EXPECT_EQ(sent.front(), "0.0000,0.0000,5.0000");
    EXPECT_THAT(sent, testing::Contains("10.0000,5.0000,-1.0000"));
}

TEST(PointsDriver, RestsAtAToolChangeWithTheReasonInTheLog) {
    PointsBench bench(lines(2));
    std::vector<std::string> waits;
    const jobs::JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const jobs::JobReport& report) {
        if (report.driver.state == DriverState::holding) {
            waits.push_back(report.driver.message);
            bench.dispatcher.resume();
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    ASSERT_EQ(waits.size(), 2U);
    EXPECT_THAT(waits[0], HasSubstr("put in tool 1"));
    EXPECT_THAT(waits[1], HasSubstr("change to tool 2"));
    int waiting = 0;
    for (const jobs::LogRecord& record : jobs::read_job_log(outcome.log_file).records) {
        waiting += record.event == jobs::LogEvent::waiting ? 1 : 0;
    }
    EXPECT_EQ(waiting, 2);
}

TEST(PointsDriver, AStopIsInTheLogWithWhatWasExecuted) {
    PointsBench bench(lines(1), 1.0);
    const jobs::JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const jobs::JobReport& report) {
        if (report.driver.executed_blocks >= 3) {
            bench.dispatcher.stop();
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::stopped);
    EXPECT_LT(outcome.executed_blocks, bench.job.block_count());
    const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
    EXPECT_EQ(log.end(), jobs::JobEnd::stopped);
    EXPECT_EQ(log.executed_blocks(), outcome.executed_blocks);
    EXPECT_EQ(static_cast<std::int64_t>(bench.sent().size()), bench.driver.played().sent);
    EXPECT_EQ(jobs::resume_point(jobs::job_story(outcome.log_file)).why_the_beginning,
              "points are always run from the first one");
}

TEST(PointsDriver, AnEmergencyStopIsAFaultUntilItIsReset) {
    PointsBench bench(lines(1), 1.0);
    const jobs::JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const jobs::JobReport& report) {
        if (report.driver.executed_blocks >= 3) {
            bench.driver.emergency_stop();
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::fault);
    EXPECT_THAT(outcome.sentence, HasSubstr("emergency stop"));
    EXPECT_EQ(bench.driver.status().state, DriverState::alarm);
    EXPECT_THROW((void)bench.dispatcher.run(bench.job, {}), Error);
    bench.driver.reset();
    EXPECT_EQ(bench.driver.status().state, DriverState::idle);
    // Its track starts elsewhere than where the table is now.
    try {
        (void)bench.dispatcher.run(bench.job, {});
        ADD_FAILURE() << "it runs";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the points start at X 0.000 Y 0.000 Z 5.000"));
    }
}

TEST(PointsDriver, PointsGoToNoOtherDriverAndNothingElseGoesHere) {
    PointsBench bench(lines(1));
    VirtualMachine other(bench.job.program->start, {}, bench.clock);
    jobs::Dispatcher wrong(other, bench.clock, bench.folder.path() / "logs");
    EXPECT_THROW((void)wrong.run(bench.job, {}), Error);
    jobs::Job plain = bench.job;
    plain.points.reset();
    EXPECT_THROW((void)bench.dispatcher.run(plain, {}), Error);
    EXPECT_FALSE(std::filesystem::exists(bench.folder.path() / "logs"));
}

} // namespace
} // namespace millwright::drivers
