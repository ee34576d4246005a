// Jobs in the Machine workspace: begun at a line, changed while they run, and found again after a crash.
#include "core/base/files.h"
#include "core/machine/job.h"
#include "core/machine/job_log.h"
#include "core/machine/job_queue.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/panels/grbl_bench.h"
#include "tests/ui/panels/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using machine::DriverKind;
using machine::DriverState;
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
constexpr int middle = 11;

class MachineJobs : public ::testing::Test {
protected:
    [[nodiscard]] static bool is(Person& person, DriverState state) {
        const auto machine = person.workshop().look().controller;
        return machine.connected() && machine.status.state == state;
    }

    static void connect(Person& person, GrblBench& grbl) {
        person.workshop().run("view.machine");
        person.workshop().session().hand.choice.kind = DriverKind::grbl;
        person.workshop().session().hand.choice.address = grbl.port();
        person.frames(3);
        person.click("inspector/connection/machine_connect");
        ASSERT_TRUE(person.live_until([&] { return person.workshop().look().controller.connected(); }));
        if (is(person, DriverState::alarm)) {
            person.workshop().run("machine.reset");
        }
        ASSERT_TRUE(person.live_until([&] { return is(person, DriverState::idle); }));
    }

    static std::filesystem::path program(const std::filesystem::path& folder) {
        write_file(folder / "part.ngc", far_first);
        return folder / "part.ngc";
    }

    /// The log of a Grbl job of which `executed` blocks were done when its program was killed.
    static std::filesystem::path
    broken_log(const std::filesystem::path& folder, const std::filesystem::path& file, int executed) {
        const machine::Job job = machine::text_job(read_file(file), file);
        machine::JobLog log(folder, "part");
        machine::LogStart start;
        start.job = "part";
        start.project = file.string();
        start.driver = "grbl";
        start.started_at = "2026-11-21 12:00:00";
        start.program_hash = machine::program_hash(job.listing->text);
        start.axes = {{'X', kinematics::AxisKind::linear}};
        start.blocks = job.block_count();
        log.write(start);
        machine::LogRecord record;
        record.event = machine::LogEvent::ahead;
        record.position = kinematics::AxisPositions::Zero(1);
        record.line = 1;
        record.allowed_blocks = job.block_count();
        log.write(record);
        record.event = machine::LogEvent::executed;
        record.executed_blocks = executed;
        record.line = job.listing->line_of_block[static_cast<std::size_t>(executed)];
        log.write(record);
        return log.file();
    }
};

TEST_F(MachineJobs, BeginAtALineBehindAnApproachThatWasShownFirst) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.workshop().run("view.machine");
    person.frames(3);
    person.click("inspector/job/begin/on");
    person.fill_in("inspector/job/begin/line", std::to_string(middle));
    person.wait_idle();
    const auto approach = person.workshop().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    EXPECT_THAT(approach->lines, testing::Contains(HasSubstr("G0 Z5.000000")));
    EXPECT_THAT(approach->lines, testing::Contains(HasSubstr("X6.000000 Y3.000000")));
    person.keep("machine-from-line");
    EXPECT_FALSE(grbl.moving());

    person.click("inspector/job/machine_run");
    double farthest = 0.0;
    ASSERT_TRUE(person.live_until(
        [&] {
            farthest = std::max(farthest, grbl.position()[0]);
            return person.workshop().look().job.outcome.has_value();
        },
        60.0));
    const auto job = person.workshop().look().job;
    EXPECT_EQ(job.outcome->end, machine::JobEnd::done) << job.outcome->sentence;
    EXPECT_LT(farthest, 10.0); // never where the lines before went
    EXPECT_NEAR(grbl.position()[0], 2.0, 0.01);
    EXPECT_EQ(machine::read_job_log(job.outcome->log_file).start.from_line, middle);
    EXPECT_FALSE(person.workshop().session().begin.on); // the next job begins at its beginning
}

TEST_F(MachineJobs, SayWhyALineIsNoPlaceToBegin) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.workshop().run("view.machine");
    person.workshop().session().begin = {true, middle, -9.0, {}};
    person.wait_idle();
    ASSERT_TRUE(person.workshop().look().approach->refusal);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("the clearance Z-9.000 is below"));
    person.keep("machine-from-line-refused");
    person.workshop().run("machine.run");
    person.frames(5);
    EXPECT_FALSE(person.workshop().look().job.running);
}

TEST_F(MachineJobs, WaitInAQueueAndBeginOneByOneByAPersonsWord) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    const auto to_x = [&](const std::string& name, int x) {
        const auto file = person.folder() / (name + ".ngc");
        write_file(file, "G21 G90 G94\nG1 F3000 X" + std::to_string(x) + "\nM2\n");
        person.open(file);
        person.workshop().run("view.machine");
        person.frames(3);
        person.click("lower/queue/queue_add");
    };
    person.click("lower/tabs/queue");
    to_x("first", 2);
    to_x("second", 4);
    to_x("third", 6);
    person.click("lower/queue/jobs/job2");
    person.click("lower/queue/later"); // first, third, second
    person.keep("machine-queue");
    EXPECT_FALSE(grbl.moving());
    const auto done = [&] {
        return std::ranges::count(
            person.workshop().look().queue, machine::QueueState::done, &machine::QueuedJob::state);
    };
    const auto run_next = [&](double x) {
        ASSERT_TRUE(person.live_until([&] { return is(person, DriverState::idle); }));
        person.frames(2);
        const auto before = done();
        person.click("lower/queue/queue_run_next");
        ASSERT_TRUE(person.live_until(
            [&] { return done() == before + 1 && !person.workshop().look().job.running; }, 60.0));
        EXPECT_NEAR(grbl.position()[0], x, 0.01);
        person.frames(20);
        EXPECT_FALSE(person.workshop().look().job.running); // the next waits for its word
    };
    run_next(2.0);
    run_next(6.0);
    const auto queue = person.workshop().look().queue;
    ASSERT_EQ(queue.size(), 3U);
    EXPECT_EQ(queue[1].name, "third");
    EXPECT_EQ(queue[1].state, machine::QueueState::done);
    EXPECT_EQ(queue[2].state, machine::QueueState::waiting);

    // A job that does not end well holds what is behind it until a person has decided.
    ASSERT_TRUE(person.live_until([&] { return is(person, DriverState::idle); }));
    person.frames(2);
    person.click("lower/queue/queue_run_next");
    person.workshop().run("machine.emergency_stop");
    ASSERT_TRUE(person.live_until([&] { return !person.workshop().look().job.running; }));
    ASSERT_TRUE(person.live_until(
        [&] { return person.workshop().look().queue[2].state == machine::QueueState::held; }));
    person.frames(3);
    EXPECT_THAT(person.refusal("lower/queue/queue_run_next"), HasSubstr("second did not end well"));
    person.keep("machine-queue-held");
    person.click("lower/queue/queue_remove_done");
    EXPECT_EQ(person.workshop().look().queue.size(), 1U);
    person.click("lower/queue/jobs/job2");
    person.click("lower/queue/release");
    EXPECT_EQ(person.workshop().look().queue[0].state, machine::QueueState::waiting);
}

TEST_F(MachineJobs, OfTheVirtualMachineBeginAtALineToo) {
    Person person;
    person.open(program(person.folder()));
    person.workshop().run("view.machine");
    person.workshop().session().machine_speed = 0.0;
    person.workshop().session().begin = {true, middle, std::nullopt, {}};
    person.wait_idle();
    const auto approach = person.workshop().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    person.workshop().run("machine.run");
    ASSERT_TRUE(person.live_until([&] { return person.workshop().look().job.outcome.has_value(); }, 60.0));
    const auto outcome = *person.workshop().look().job.outcome;
    EXPECT_EQ(outcome.end, machine::JobEnd::done) << outcome.sentence;
    EXPECT_NEAR(outcome.position[0], 2.0, 1e-6);
    EXPECT_LT(outcome.executed_blocks, 16);
}

TEST_F(MachineJobs, LogTheOverridesOfAPerson) {
    GrblBench grbl;
    Person person;
    connect(person, grbl);
    person.open(program(person.folder()));
    person.workshop().run("view.machine");
    person.frames(3);
    person.click("inspector/job/machine_run");
    ASSERT_TRUE(person.live_until([&] { return grbl.position()[0] > 1.0; }));
    actions::ActionQueue ask;
    ask.set_overrides({.feed = 200, .rapid = 50, .spindle = 100});
    person.workshop().perform(ask);
    ASSERT_TRUE(
        person.live_until([&] { return person.workshop().look().controller.status.overrides.feed == 200; }));
    person.workshop().run("machine.stop");
    ASSERT_TRUE(person.live_until([&] { return person.workshop().look().job.outcome.has_value(); }));
    const auto log = machine::read_job_log(person.workshop().look().job.outcome->log_file);
    const auto entry =
        std::ranges::find(log.records, machine::LogEvent::overrides, &machine::LogRecord::event);
    ASSERT_NE(entry, log.records.end());
    EXPECT_THAT(entry->text, HasSubstr("feed 200 %, rapid 50 %"));
}

TEST_F(MachineJobs, ThatWereBrokenOffAreToldOfAtTheStartAndGoOnFromTheirLine) {
    const test::ScratchFolder folder;
    const auto file = program(folder.path());
    const auto log = broken_log(folder / "logs", file, 10);
    GrblBench grbl;
    Person person({1280, 800}, {}, folder / "logs");
    person.wait_idle();
    ASSERT_TRUE(person.sees("dialogs/broken_job/broken_job_continue"));
    EXPECT_THAT(person.workshop().look().broken_jobs->front().sentence, HasSubstr("10 of 15 blocks"));
    person.keep("job-recovery");
    person.click("dialogs/broken_job/broken_job_continue");
    person.wait_idle();
    EXPECT_FALSE(person.workshop().look().asks());
    EXPECT_EQ(person.workshop().session().workspace, Workspace::machine);
    EXPECT_EQ(person.workshop().session().begin.line, 11);
    EXPECT_FALSE(person.workshop().look().job.running);
    connect(person, grbl);
    person.wait_idle();
    const auto approach = person.workshop().look().approach;
    ASSERT_TRUE(approach && approach->job) << (approach ? approach->refusal->message : "no answer");
    EXPECT_FALSE(grbl.moving());

    // Another program would be begun at a line that means something else there.
    write_file(file, std::string("(changed)\n") + far_first);
    person.workshop().session().begin.hash = machine::read_job_log(log).start.program_hash;
    const actions::BeginAt begin = person.workshop().session().begin;
    person.open(file);
    person.workshop().run("view.machine");
    person.workshop().session().begin = begin;
    person.wait_idle();
    ASSERT_TRUE(person.workshop().look().approach->refusal);
    EXPECT_THAT(person.workshop().look().approach->refusal->message, HasSubstr("changed since"));
}

TEST_F(MachineJobs, ThatWereDismissedAreNotAskedAboutAgain) {
    const test::ScratchFolder folder;
    const auto log = broken_log(folder / "logs", program(folder.path()), 10);
    {
        Person person({1280, 800}, {}, folder / "logs");
        person.wait_idle();
        person.click("dialogs/broken_job/broken_job_later");
        EXPECT_FALSE(person.workshop().look().asks());
    }
    {
        Person person({1280, 800}, {}, folder / "logs");
        person.wait_idle();
        person.click("dialogs/broken_job/broken_job_dismiss");
        EXPECT_FALSE(person.workshop().look().asks());
    }
    Person person({1280, 800}, {}, folder / "logs");
    person.wait_idle();
    EXPECT_FALSE(person.workshop().look().asks());
    EXPECT_TRUE(std::filesystem::exists(log));
}

} // namespace
} // namespace millwright::panels
