#include "core/jobs/recovery.h"

#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

namespace millwright::jobs {
namespace {

using testing::HasSubstr;

LogStart start_of(int blocks) {
    LogStart start;
    start.job = "part";
    start.driver = "grbl";
    start.axes = {{'X', kinematics::AxisKind::linear}};
    start.blocks = blocks;
    return start;
}

LogRecord log_record_of_line(LogEvent event, int executed, int line, int allowed = 0) {
    LogRecord result;
    result.event = event;
    result.executed_blocks = executed;
    result.line = line;
    result.allowed_blocks = allowed;
    result.position = kinematics::AxisPositions::Zero(1);
    return result;
}

struct StoppedJobBench {
    test::ScratchFolder folder;
    std::optional<JobLog> log;
    std::filesystem::path file;

    StoppedJobBench() {
        log.emplace(folder / "logs", "part");
        file = log->file();
        log->write(start_of(100));
        log->write(log_record_of_line(LogEvent::ahead, 0, 1, 40));
        log->write(log_record_of_line(LogEvent::executed, 12, 15));
        log->write(log_record_of_line(LogEvent::ahead, 12, 15, 60));
    }
    [[nodiscard]] JobStory story() const { return job_story(file); }
};

TEST(Recovery, TellsARunningJobFromOneWhoseProgramWasKilled) {
    StoppedJobBench bench;
    EXPECT_TRUE(bench.story().running);
    EXPECT_FALSE(bench.story().broken_off());
    bench.log.reset(); // as the end of its program does
    const JobStory story = bench.story();
    EXPECT_TRUE(story.broken_off());
    EXPECT_EQ(story.executed_blocks, 12);
    EXPECT_EQ(story.allowed_blocks, 60);
    EXPECT_EQ(story.next_line, 15);
    EXPECT_THAT(story.sentence,
                HasSubstr("12 of 100 blocks were confirmed as executed (next line: 15); the next 48 may have "
                          "been as well; the rest were never sent"));
}

TEST(Recovery, AJobThatEndedInItsApproachGoesOnFromItsLine) {
    test::ScratchFolder folder;
    LogStart start = start_of(100);
    start.from_line = 30;
    JobLog log(folder / "logs", "part");
    log.write(start);
    log.write(log_record_of_line(LogEvent::ahead, 0, 1, 7));
    log.write(log_record_of_line(LogEvent::executed, 3, 4));
    EXPECT_EQ(job_story(log.file()).next_line, 30);
    log.write(log_record_of_line(LogEvent::executed, 9, 33));
    EXPECT_EQ(job_story(log.file()).next_line, 33);
}

TEST(Recovery, RemembersThatAPersonHasSeenWhatBecameOfAJob) {
    StoppedJobBench bench;
    bench.log.reset();
    const std::string before = read_file(bench.file);
    EXPECT_FALSE(bench.story().seen);
    mark_seen(bench.file);
    EXPECT_TRUE(bench.story().seen);
    EXPECT_TRUE(bench.story().broken_off());
    EXPECT_EQ(read_file(bench.file), before);
    EXPECT_EQ(read_job_folder(bench.folder / "logs").jobs.size(), 1U); // the mark is no log
}

TEST(Recovery, TellsHowAJobEnded) {
    StoppedJobBench bench;
    LogRecord end = log_record_of_line(LogEvent::end, 12, 15);
    end.end = JobEnd::stopped;
    bench.log->write(end);
    EXPECT_FALSE(bench.story().running); // its end is written
    EXPECT_FALSE(bench.story().broken_off());
    EXPECT_THAT(bench.story().sentence, HasSubstr("stopped after"));
}

TEST(Recovery, LeavesOutALineThatWasCutOff) {
    StoppedJobBench bench;
    bench.log.reset();
    const std::string text = read_file(bench.file);
    write_file(bench.file, text + R"({"record":"executed","time_s":1,"executed_b)");
    EXPECT_EQ(bench.story().executed_blocks, 12);
}

TEST(Recovery, ReadsAFolderAndNamesWhatIsNoLog) {
    StoppedJobBench bench;
    bench.log.reset();
    write_file(bench.folder / "logs" / "other.jsonl", "nonsense\n");
    write_file(bench.folder / "logs" / "notes.txt", "nonsense\n");
    const JobFolder folder = read_job_folder(bench.folder / "logs");
    EXPECT_EQ(folder.jobs.size(), 1U);
    ASSERT_EQ(folder.unreadable.size(), 1U);
    EXPECT_EQ(folder.unreadable[0].place.file.filename(), "other.jsonl");
    EXPECT_TRUE(read_job_folder(bench.folder / "nothing").jobs.empty());
}

} // namespace
} // namespace millwright::jobs
