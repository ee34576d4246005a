// Jobs in the Machine workspace: begun at a line, changed while they run, and found again after a crash.
#include "core/base/files.h"
#include "core/jobs/job.h"
#include "core/jobs/job_log.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/at_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using test::connect;
using test::GrblBench;
using test::Person;
using testing::HasSubstr;

/// Goes to X60 in line 5 and never again.
constexpr const char* far_first = "G21 G90 G94 G17\n"
                                  "G0 Z5\n"
                                  "G0 X0 Y0\n"
                                  "G1 Z-1 F600\n"
                                  "X60\n"
                                  "Y3\n"
                                  "X8 Y3\n"
                                  "X8 Y0\n"
                                  "X6 Y0\n"
                                  "X6 Y3\n"
                                  "X4 Y3\n"
                                  "X4 Y0\n"
                                  "X2 Y0\n"
                                  "G0 Z5\n"
                                  "M2\n";
constexpr int middle_line = 12;

class MachineJobs : public ::testing::Test {
protected:
    static std::filesystem::path program(const std::filesystem::path& folder) {
        write_file(folder / "part.ngc", far_first);
        return folder / "part.ngc";
    }

    /// The log of a Grbl job of which `executed` blocks were done when its program was killed.
    static std::filesystem::path
    broken_log(const std::filesystem::path& folder, const std::filesystem::path& file, int executed) {
        const jobs::Job job = jobs::text_job(read_file(file), file);
        jobs::JobLog log(folder, "part");
        jobs::LogStart start;
        start.job = "part";
        start.project = file.string();
        start.driver = "grbl";
        start.started_at = "2026-11-21 12:00:00";
        start.program_hash = jobs::program_hash(job.listing->text);
        start.axes = {{'X', kinematics::AxisKind::linear}};
        start.blocks = job.block_count();
        log.write(start);
        jobs::LogRecord record;
        record.event = jobs::LogEvent::ahead;
        record.position = kinematics::AxisPositions::Zero(1);
        record.line = 1;
        record.allowed_blocks = job.block_count();
        log.write(record);
        record.event = jobs::LogEvent::executed;
        record.executed_blocks = executed;
        record.line = job.listing->line_of_block[static_cast<std::size_t>(executed)];
        log.write(record);
        return log.file();
    }
};

TEST_F(MachineJobs, AreNotEndedByClosingTheWindowUnlessAPersonSaysSo) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    write_file(person.folder() / "long.ngc", "G21 G90 G94\nG1 X70 F60\nX0\nM2\n");
    person.open(person.folder() / "long.ngc");
    person.app().run("view.machine");
    person.frames(3);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return grbl.moving(); }));
    const auto& view_state = person.app().view_state();

    person.press_key(render::Key::q, true);
    ASSERT_TRUE(person.sees("dialogs/running_job/running_job_stop"));
    EXPECT_FALSE(view_state.quit);
    person.keep("machine-quit-while-running");
    person.press_key(render::Key::escape);
    EXPECT_FALSE(person.sees("dialogs/running_job/running_job_stop"));
    EXPECT_TRUE(person.app().look().job.running);
    EXPECT_TRUE(grbl.moving());

    person.press_key(render::Key::q, true);
    person.click("dialogs/running_job/running_job_stop");
    EXPECT_TRUE(view_state.quit);
    ASSERT_TRUE(person.live_until([&] { return !person.app().look().job.running; }));
    EXPECT_EQ(person.app().look().job.outcome->end, jobs::JobEnd::stopped);
    EXPECT_FALSE(grbl.moving());
}

TEST_F(MachineJobs, LeaveNothingBehindOfALineThatWasRefusedBefore) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    write_file(person.folder() / "short.ngc", "G21 G90 G94\nG1 X5 F3000\nM2\n");
    person.open(person.folder() / "short.ngc");
    person.app().run("view.machine");
    person.frames(3);
    person.fill_in("lower/command", "G1 X5 F0");
    ASSERT_TRUE(person.live_until([&] { return person.sees("lower/refused"); }));
    ASSERT_TRUE(person.live_until([&] { return test::machine_is(person, drivers::DriverState::idle); }));
    EXPECT_TRUE(person.sees("lower/refused")) << "until something else is done";
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return person.app().look().job.running; }));
    EXPECT_TRUE(person.live_until([&] { return !person.sees("lower/refused"); }));
    EXPECT_TRUE(person.sees("lower/command"));
    ASSERT_TRUE(person.live_until([&] { return !person.app().look().job.running; }));
}

TEST_F(MachineJobs, ThatEndMeanwhileAreNotAskedAbout) {
    Person person;
    write_file(person.folder() / "short.ngc", "G21 G90 G94\nG1 X5 F3000\nM2\n");
    GrblBench grbl;
    connect(person, grbl);
    person.open(person.folder() / "short.ngc");
    person.app().run("view.machine");
    person.frames(3);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return person.app().look().job.outcome.has_value(); }));
    person.app().view_state().dialogs.quit = true; // pressed in the frame before the end was seen
    person.frames(2);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_FALSE(person.app().view_state().quit);
}

TEST_F(MachineJobs, BeginAtALineBehindAnApproachThatWasShownFirst) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.app().run("view.machine");
    person.frames(3);
    person.click("inspector/job/begin/on");
    person.fill_in("inspector/job/begin/line", std::to_string(middle_line));
    person.wait_idle();
    const auto approach = person.app().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    EXPECT_THAT(approach->lines, testing::Contains(HasSubstr("G0 Z5")));
    EXPECT_THAT(approach->lines, testing::Contains(HasSubstr("X4 Y3")));
    person.keep("machine-from-line");
    EXPECT_FALSE(grbl.moving());

    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("The position may be lost"));
    person.keep("machine-from-line-position");
    person.click("inspector/job/begin/trust"); // this Grbl was switched on and not homed
    ASSERT_TRUE(person.live_until([&] { return !person.sees("inspector/job/begin/trust"); }));
    test::press_run(person);
    double farthest = 0.0;
    int first_line = middle_line;
    ASSERT_TRUE(person.live_until(
        [&] {
            const auto shown = person.app().look();
            if (shown.job.running && shown.job.report) {
                first_line = std::min(first_line, shown.file_place().value().line);
            }
            farthest = std::max(farthest, grbl.position()[0]);
            return person.app().look().job.outcome.has_value();
        },
        60.0));
    const auto job = person.app().look().job;
    EXPECT_EQ(job.outcome->end, jobs::JobEnd::done) << job.outcome->sentence;
    EXPECT_LT(farthest, 10.0); // never where the lines before went
    EXPECT_EQ(first_line, middle_line);
    EXPECT_GE(person.app().look().file_place().value().line, 14);
    EXPECT_NEAR(grbl.position()[0], 2.0, 0.01);
    EXPECT_EQ(jobs::read_job_log(job.outcome->log_file).start.from_line, middle_line);
    EXPECT_FALSE(person.app().view_state().start_at.on); // the next job begins at its beginning
}

TEST_F(MachineJobs, SayWhyALineIsNoPlaceToBegin) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.app().run("view.machine");
    person.app().view_state().start_at = {true, middle_line, -9.0, {}};
    person.wait_idle();
    ASSERT_TRUE(person.app().look().approach->refusal);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("the clearance Z-9.000 is below"));
    person.keep("machine-from-line-refused");
    person.app().run("machine.run");
    person.frames(5);
    EXPECT_FALSE(person.app().look().job.running);
}

TEST_F(MachineJobs, OfTheVirtualMachineBeginAtALineToo) {
    Person person;
    person.open(program(person.folder()));
    person.app().run("view.machine");
    person.app().view_state().machine_speed = 0.0;
    person.app().view_state().start_at = {true, middle_line, std::nullopt, {}};
    person.wait_idle();
    const auto approach = person.app().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    person.app().run("machine.run");
    ASSERT_TRUE(person.live_until([&] { return person.app().look().job.outcome.has_value(); }, 60.0));
    const auto outcome = *person.app().look().job.outcome;
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_NEAR(outcome.position[0], 2.0, 1e-6);
    EXPECT_LT(outcome.executed_blocks, 16);
}

TEST_F(MachineJobs, LogTheOverridesOfAPerson) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.app().run("view.machine");
    person.frames(3);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return grbl.position()[0] > 1.0; }));
    actions::ActionQueue ask;
    ask.set_overrides({.feed = 200, .rapid = 50, .spindle = 100});
    person.app().perform(ask);
    ASSERT_TRUE(
        person.live_until([&] { return person.app().look().connection.status.overrides.feed == 200; }));
    person.app().run("machine.stop");
    ASSERT_TRUE(person.live_until([&] { return person.app().look().job.outcome.has_value(); }));
    const auto log = jobs::read_job_log(person.app().look().job.outcome->log_file);
    const auto entry = std::ranges::find(log.records, jobs::LogEvent::overrides, &jobs::LogRecord::event);
    ASSERT_NE(entry, log.records.end());
    EXPECT_THAT(entry->text, HasSubstr("feed 200 %, rapid 50 %"));
}

TEST_F(MachineJobs, ThatWereBrokenOffAreToldOfWithNoNoticeOverIt) {
    const test::ScratchFolder folder;
    const auto file = program(folder.path());
    const auto log = broken_log(folder / "logs", file, 11);
    Person person({1280, 800}, {}, folder / "logs");
    person.wait_idle();
    person.app().receive({file});
    person.frames(3);
    ASSERT_TRUE(person.sees("dialogs/broken_job/broken_job_dismiss"));
    ASSERT_TRUE(person.sees("notices/1"));
    person.keep("job-recovery-with-a-notice");
    const widgets::Rect notice = person.desktop().ui().place("notices/1").value();
    for (const char* part : {"broken_job_later", "broken_job_dismiss", "broken_job_continue", "look"}) {
        const widgets::Rect its =
            person.desktop().ui().place("dialogs/broken_job/" + std::string(part)).value();
        EXPECT_TRUE(notice.y > its.bottom() || notice.x > its.right()) << part;
    }
}

TEST_F(MachineJobs, ThatWereBrokenOffAreToldOfAtTheStartAndGoOnFromTheirLine) {
    const test::ScratchFolder folder;
    const auto file = program(folder.path());
    const auto log = broken_log(folder / "logs", file, 11);
    GrblBench grbl;
    Person person({1280, 800}, {}, folder / "logs");
    person.wait_idle();
    ASSERT_TRUE(person.sees("dialogs/broken_job/broken_job_continue"));
    EXPECT_THAT(person.app().look().broken_jobs->front().sentence, HasSubstr("11 of 15 blocks"));
    person.keep("job-recovery");
    person.click("dialogs/broken_job/broken_job_continue");
    person.wait_idle();
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_EQ(person.app().view_state().workspace, Workspace::machine);
    EXPECT_EQ(person.app().view_state().start_at.line, 12);
    EXPECT_FALSE(person.app().look().job.running);
    connect(person, grbl);
    person.wait_idle();
    const auto approach = person.app().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    EXPECT_FALSE(grbl.moving());

    // Another program would be begun at a line that means something else there.
    write_file(file, std::string("(changed)\n") + far_first);
    person.app().view_state().start_at.hash = jobs::read_job_log(log).start.program_hash;
    const actions::StartAt begin = person.app().view_state().start_at;
    person.open(file);
    person.app().run("view.machine");
    person.app().view_state().start_at = begin;
    person.wait_idle();
    ASSERT_TRUE(person.app().look().approach->refusal);
    EXPECT_THAT(person.app().look().approach->refusal->message, HasSubstr("changed since"));
}

TEST_F(MachineJobs, ThatWereDismissedAreNotAskedAboutAgain) {
    const test::ScratchFolder folder;
    const auto log = broken_log(folder / "logs", program(folder.path()), 10);
    {
        Person person({1280, 800}, {}, folder / "logs");
        person.wait_idle();
        person.click("dialogs/broken_job/broken_job_later");
        EXPECT_FALSE(person.app().look().asks());
    }
    {
        Person person({1280, 800}, {}, folder / "logs");
        person.wait_idle();
        person.click("dialogs/broken_job/broken_job_dismiss");
        EXPECT_FALSE(person.app().look().asks());
    }
    Person person({1280, 800}, {}, folder / "logs");
    person.wait_idle();
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_TRUE(std::filesystem::exists(log));
}

} // namespace
} // namespace millwright::panels
