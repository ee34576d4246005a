#include "core/jobs/job_log.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/support/jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <sstream>

namespace millwright::jobs {
namespace {

using ::testing::HasSubstr;

LogStart start() {
    LogStart start;
    start.job = "dome";
    start.project = "d\xC3\xB4me \"1\".json";
    start.machine = "Rotary-tilt";
    start.driver = "virtual";
    start.program_hash = "0123456789abcdef";
    start.started_at = "2026-01-02 03:04:05";
    start.axes = {{'X', kinematics::AxisKind::linear}, {'A', kinematics::AxisKind::rotary}};
    start.blocks = 12;
    start.planned_time = 34.5;
    return start;
}

LogRecord log_record_at(LogEvent event, double time, int executed) {
    LogRecord record;
    record.event = event;
    record.time = time;
    record.executed_blocks = executed;
    record.line = executed + 3;
    record.position = kinematics::AxisPositions::Zero(2);
    record.position << 1.25, from_degrees(30.0);
    return record;
}

std::filesystem::path written_log(const std::filesystem::path& folder) {
    JobLog log(folder, "dome");
    log.write(start());
    log.write(log_record_at(LogEvent::executed, 0.5, 4));
    log.write(log_record_at(LogEvent::hold, 0.75, 5));
    LogRecord end = log_record_at(LogEvent::end, 1.5, 6);
    end.end = JobEnd::stopped;
    end.text = "The machine was stopped.";
    log.write(end);
    return log.file();
}

TEST(JobLog, ReadsBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    const ReadLog log = read_job_log(written_log(folder.path()));
    EXPECT_EQ(log.start, start());
    ASSERT_EQ(log.records.size(), 3U);
    EXPECT_EQ(log.records[1].event, LogEvent::hold);
    EXPECT_EQ(log.records[1].time, 0.75);
    EXPECT_NEAR(log.records[1].position[1], from_degrees(30.0), 1e-12);
    EXPECT_EQ(log.records[2].text, "The machine was stopped.");
    EXPECT_EQ(log.executed_blocks(), 6);
    EXPECT_EQ(log.end(), JobEnd::stopped);
    EXPECT_FALSE(log.torn);
}

TEST(JobLog, IsOnDiskBeforeTheNextThingHappens) {
    const test::TemporaryFolder folder;
    JobLog log(folder.path(), "dome");
    log.write(start());
    log.write(log_record_at(LogEvent::executed, 0.5, 4));
    EXPECT_EQ(read_job_log(log.file()).executed_blocks(), 4);
}

/// As when the disk is full for a while.
TEST(JobLog, GoesOnBehindALineThatDidNotFit) {
    const test::TemporaryFolder folder;
    JobLog log(folder.path(), "full");
    log.write(start());
    LogRecord next = log_record_at(LogEvent::executed, 0.5, 4);
    log.write(next);
    const auto whole = std::filesystem::file_size(log.file());
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit tight = before;
    tight.rlim_cur = whole + 20;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    EXPECT_THROW(log.write(next), Error);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    (void)std::signal(SIGXFSZ, handler);
    EXPECT_EQ(std::filesystem::file_size(log.file()), whole);
    next.text = "the end";
    log.write(next);
    const ReadLog read = read_job_log(log.file());
    ASSERT_EQ(read.records.size(), 2U);
    EXPECT_EQ(read.records.back().text, "the end");
}

TEST(JobLog, ToleratesALastLineCutOffAnywhere) {
    const test::TemporaryFolder folder;
    const std::string whole = read_file(written_log(folder.path()));
    const std::size_t first_end = whole.find('\n') + 1;
    const std::filesystem::path cut = folder.path() / "cut.jsonl";
    for (std::size_t length = first_end; length < whole.size(); ++length) {
        std::ofstream(cut, std::ios::trunc) << whole.substr(0, length);
        const ReadLog log = read_job_log(cut);
        EXPECT_EQ(log.torn, whole[length - 1] != '\n');
        EXPECT_LT(log.records.size(), 3U);
        EXPECT_FALSE(log.end().has_value());
    }
    write_file(cut, whole.substr(0, first_end - 1));
    EXPECT_THROW((void)read_job_log(cut), Error);
}

TEST(JobLog, NamesTheLineOfAnythingElseThatIsWrong) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "bad.jsonl";
    const std::string whole = read_file(written_log(folder.path()));
    const std::string first = whole.substr(0, whole.find('\n') + 1);
    for (const char* bad :
         {"{\"record\": \"executed\"}\n",
          "not json\n",
          "{\"record\":\"dance\",\"time_s\":1,\"executed_blocks\":1,\"line\":1,\"position\":[0,0]}\n",
          "{\"record\":\"hold\",\"time_s\":1,\"executed_blocks\":99,\"line\":1,\"position\":[0,0]}\n",
          "{\"record\":\"hold\",\"time_s\":1,\"executed_blocks\":1,\"line\":1,\"position\":[0]}\n",
          "\n"}) {
        write_file(file, first + bad);
        try {
            (void)read_job_log(file);
            FAIL() << "accepted " << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.diagnostic().place.line, 2) << error.what();
        }
    }
    write_file(file, "{}\n");
    EXPECT_THROW((void)read_job_log(file), Error);
}

TEST(JobLog, LooksAsItsReferencePageShows) {
    const test::TemporaryFolder folder;
    std::istringstream page(read_file("docs/reference/job-log.md"));
    std::string shown;
    for (std::string line; std::getline(page, line);) {
        shown += line.rfind("{\"record\"", 0) == 0 ? line + "\n" : "";
    }
    write_file(folder.path() / "shown.jsonl", shown);
    const ReadLog log = read_job_log(folder.path() / "shown.jsonl");
    EXPECT_EQ(log.records.size(), 1U);
    JobLog again(folder.path(), "again");
    again.write(log.start);
    again.write(log.records[0]);
    EXPECT_EQ(read_file(again.file()), shown);
}

TEST(JobLog, NeverOverwritesAnOlderOne) {
    const test::TemporaryFolder folder;
    const JobLog first(folder.path(), "dome");
    const JobLog second(folder.path(), "dome");
    EXPECT_EQ(first.file().filename(), "dome-0001.jsonl");
    EXPECT_EQ(second.file().filename(), "dome-0002.jsonl");
}

TEST(JobLog, StaysInItsFolderWhateverTheJobIsCalled) {
    const test::TemporaryFolder folder;
    const JobLog log(folder.path(), "../a b/\xE0\xB9\x82");
    EXPECT_EQ(log.file().parent_path(), folder.path());
    EXPECT_THAT(log.file().filename().string(), HasSubstr("a_b"));
}

TEST(JobLog, SaysWhyItCannotBeMade) {
    const test::TemporaryFolder folder;
    write_file(folder.path() / "file", "");
    EXPECT_THROW(JobLog(folder.path() / "file" / "logs", "dome"), Error);
}

} // namespace
} // namespace millwright::jobs
