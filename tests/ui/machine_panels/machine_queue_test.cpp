// The job queue of the Machine workspace: one job after another, each by a person's word, and what becomes of
// them when the window is closed, killed, or opened twice.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/jobs/job_queue.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/at_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using jobs::JobEnd;
using jobs::QueuedJob;
using jobs::QueueState;
using test::connect;
using test::GrblBench;
using test::machine_is;
using test::Person;
using testing::HasSubstr;

class MachineQueue : public ::testing::Test {
protected:
    const test::ScratchFolder folder;
    const std::filesystem::path jobs = folder / "jobs";
    const std::filesystem::path file = jobs / "queue.json";

    /// Goes to X and ends.
    [[nodiscard]] std::filesystem::path program(const std::string& name, int x, int feed = 3000) const {
        const auto path = folder / (name + ".ngc");
        write_file(path, "G21 G90 G94\nG1 F" + std::to_string(feed) + " X" + std::to_string(x) + "\nM2\n");
        return path;
    }

    /// On its way for half a minute: what a person does meanwhile finds it there on a slow computer, too.
    [[nodiscard]] std::filesystem::path slow_program(const std::string& name) const {
        return program(name, 60, 120);
    }

    static void add(Person& person, const std::filesystem::path& program) {
        person.open(program);
        person.app().run("view.machine");
        person.frames(3);
        person.click("lower/tabs/queue");
        person.click("lower/queue/queue_add");
    }

    [[nodiscard]] static std::vector<QueuedJob> queue(Person& person) { return person.app().look().queue; }

    [[nodiscard]] static std::vector<std::string> names(Person& person) {
        std::vector<std::string> names;
        for (const QueuedJob& job : queue(person)) {
            names.push_back(job.name);
        }
        return names;
    }

    static void choose(Person& person, int id) {
        person.app().run("view.machine");
        person.frames(2);
        person.click("lower/tabs/queue");
        person.click("lower/queue/jobs/job" + std::to_string(id));
    }

    static void run_next(Person& person, std::size_t place, QueueState wanted) {
        person.frames(2);
        ASSERT_EQ(person.refusal("lower/queue/queue_run_next"), "");
        if (person.app().look().connection.connected()) {
            test::press_run(person, "lower/queue/queue_run_next");
        } else {
            person.click("lower/queue/queue_run_next"); // the virtual machine needs no confirmation
        }
        ASSERT_TRUE(person.live_until(
            [&] { return queue(person)[place].state == wanted && !person.app().look().job.running; }, 60.0))
            << to_text(queue(person)[place].state);
    }
};

TEST_F(MachineQueue, OutlivesTheWindowAndIsTheCommandLinesToo) {
    GrblBench grbl;
    {
        Person person({1280, 800}, {}, jobs);
        connect(person, grbl);
        add(person, program("first", 2));
        add(person, program("second", 4));
        add(person, program("third", 6));
        run_next(person, 0, QueueState::done);
        ASSERT_TRUE(person.live_until([&] { return machine_is(person, DriverState::idle); }));
    }
    {
        const jobs::JobQueue on_the_command_line(file);
        EXPECT_EQ(on_the_command_line.next()->name, "second");
    }
    write_file(folder / "third.ngc", "G21 G90\nG0 X500\nM2\n"); // another program than was queued
    Person person({1280, 800}, {}, jobs);
    ASSERT_EQ(queue(person).size(), 3U);
    EXPECT_EQ(queue(person)[0].end, JobEnd::done);
    EXPECT_EQ(queue(person)[1].state, QueueState::waiting);
    EXPECT_FALSE(queue(person)[1].has_program);
    connect(person, grbl);
    person.click("lower/tabs/queue");
    EXPECT_THAT(person.refusal("lower/queue/queue_run_next"), HasSubstr("Open program"));
    person.keep("machine-queue-reopened");

    choose(person, 2);
    person.click("lower/queue/open");
    person.wait_idle();
    EXPECT_TRUE(queue(person)[1].has_program);
    EXPECT_EQ(person.app().look().opened->file, folder / "second.ngc");
    EXPECT_FALSE(grbl.moving());
    EXPECT_NEAR(grbl.position()[0], 2.0, 0.01);
    run_next(person, 1, QueueState::done);
    EXPECT_NEAR(grbl.position()[0], 4.0, 0.01);

    choose(person, 3);
    person.click("lower/queue/open");
    person.wait_idle();
    EXPECT_THAT(person.app().view_state().log.back(), HasSubstr("not the program that was queued"));
    EXPECT_FALSE(queue(person)[2].has_program);
    EXPECT_NE(person.refusal("lower/queue/queue_run_next"), "");
    EXPECT_NEAR(grbl.position()[0], 4.0, 0.01);
}

TEST_F(MachineQueue, RunNextIsRefusedWithTheReasonForAJobThatTheMachineCannotDo) {
    GrblBench grbl;
    Person person({1280, 800}, {}, jobs);
    connect(person, grbl);
    add(person, program("far", 500)); // its travel is 200 mm
    person.click("lower/tabs/queue");
    const std::string button = "lower/queue/queue_run_next";
    ASSERT_TRUE(person.live_until([&] { return !person.refusal(button).empty(); }));
    EXPECT_THAT(person.refusal(button), HasSubstr("far.ngc:2"));
    EXPECT_THAT(person.refusal(button), HasSubstr("its travel is only 200.000 mm"));
    choose(person, 1);
    person.click("lower/queue/remove");
    add(person, program("near", 5));
    ASSERT_TRUE(person.live_until([&] { return person.refusal(button).empty(); }));
    run_next(person, 0, QueueState::done);
    EXPECT_NEAR(grbl.position()[0], 5.0, 0.01);
}

TEST_F(MachineQueue, HoldsAJobThatWasRunningWhenTheWindowWasKilled) {
    GrblBench grbl;
    const test::ScratchFolder left;
    {
        Person person({1280, 800}, {}, jobs);
        connect(person, grbl);
        add(person, slow_program("far"));
        add(person, program("next", 1));
        test::press_run(person, "lower/queue/queue_run_next");
        ASSERT_TRUE(person.live_until([&] { return grbl.moving(); }));
        // What a killed program leaves behind is what is on the disk by now.
        write_file(left / "queue.json", read_file(file));
        person.app().run("machine.emergency_stop");
        ASSERT_TRUE(person.live_until([&] { return queue(person)[0].state == QueueState::held; }));
    }
    Person person({1280, 800}, {}, left.path());
    ASSERT_EQ(queue(person).size(), 2U);
    EXPECT_EQ(queue(person)[0].state, QueueState::held);
    EXPECT_THAT(queue(person)[0].sentence, HasSubstr("Millwright ended while the job was running"));
    person.app().run("view.machine");
    person.frames(3);
    person.click("lower/tabs/queue");
    EXPECT_THAT(person.refusal("lower/queue/queue_run_next"), HasSubstr("far did not finish successfully"));
}

TEST_F(MachineQueue, BelongsToOneWindowAndIsFreeWhenItIsEmpty) {
    auto first = std::make_unique<Person>(render::PixelSize{1280, 800}, std::filesystem::path{}, jobs);
    add(*first, program("first", 2));
    Person second({1280, 800}, {}, jobs);
    second.app().run("view.machine");
    second.frames(3);
    second.click("lower/tabs/queue");
    ASSERT_TRUE(second.app().look().queue_problem);
    EXPECT_THAT(second.app().look().queue_problem->message,
                HasSubstr("in use by another instance of Millwright"));
    EXPECT_FALSE(second.sees("lower/queue/queue_add"));
    second.keep("machine-queue-in-use");
    second.click("lower/queue/retry");
    EXPECT_TRUE(second.app().look().queue_problem);
    choose(*first, 1);
    first->click("lower/queue/remove");
    second.click("lower/queue/retry");
    second.frames(2);
    EXPECT_FALSE(second.app().look().queue_problem);
    add(second, program("second", 4));
    EXPECT_EQ(names(second), std::vector<std::string>{"second"});
}

TEST_F(MachineQueue, OfADamagedFileSaysWhereAndLeavesItAlone) {
    const std::string damaged =
        "{\n  \"format\": \"millwright-job-queue\",\n  \"version\": 99,\n  \"jobs\": []\n}\n";
    make_folder(jobs);
    write_file(file, damaged);
    Person person({1280, 800}, {}, jobs);
    const auto problem = person.app().look().queue_problem;
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->place.line, 3);
    person.open(program("first", 2));
    actions::ActionQueue ask;
    ask.run("queue.add");
    person.app().perform(ask);
    EXPECT_THAT(person.app().view_state().log.back(), HasSubstr("99"));
    EXPECT_EQ(read_file(file), damaged);
    EXPECT_TRUE(queue(person).empty());
}

TEST_F(MachineQueue, MakesAJobAnewForAnotherKindOfMachine) {
    Person person({1280, 800}, {}, jobs);
    {
        GrblBench grbl;
        connect(person, grbl);
        add(person, program("first", 2));
        EXPECT_FALSE(queue(person)[0].has_motion);
        person.click("inspector/connection/machine_disconnect");
        ASSERT_TRUE(person.live_until(
            [&] { return person.app().look().connection.link == actions::LinkState::none; }));
    }
    person.frames(2);
    EXPECT_THAT(person.refusal("lower/queue/queue_run_next"), HasSubstr("another type of machine"));
    person.app().run("queue.run_next");
    EXPECT_FALSE(person.app().look().job.running);
    choose(person, 1);
    person.click("lower/queue/open");
    person.wait_idle();
    EXPECT_TRUE(queue(person)[0].has_motion);
    person.app().view_state().machine_speed = 0.0;
    run_next(person, 0, QueueState::done);
}

TEST_F(MachineQueue, TakesNoProjectThatIsNotSaved) {
    Person person({1280, 800}, {}, jobs);
    person.app().run("view.machine");
    person.frames(3);
    person.click("lower/tabs/queue");
    EXPECT_THAT(person.refusal("lower/queue/queue_add"), HasSubstr("Save the project first"));
    person.app().save(folder / "dome.json");
    person.frames(3);
    EXPECT_EQ(person.refusal("lower/queue/queue_add"), "");
}

TEST_F(MachineQueue, SaysThatTheEndOfAJobCannotBeWritten) {
    GrblBench grbl;
    Person person({1280, 800}, {}, jobs);
    connect(person, grbl);
    add(person, slow_program("first"));
    test::press_run(person, "lower/queue/queue_run_next");
    ASSERT_TRUE(person.live_until([&] { return grbl.moving(); }));
    std::filesystem::remove(file);
    std::filesystem::create_directories(file / "in_the_way");
    person.app().run("machine.stop");
    ASSERT_TRUE(person.live_until([&] { return !person.app().look().job.running; }, 60.0));
    person.frames(2);
    EXPECT_EQ(queue(person)[0].state, QueueState::held);
    EXPECT_THAT(person.app().view_state().log, testing::Contains(HasSubstr("queue could not be written")));
    std::filesystem::remove_all(file);
}

TEST_F(MachineQueue, AJobOfAnotherFileLeavesWhatIsShownAlone) {
    GrblBench grbl;
    Person person({1280, 800}, {}, jobs);
    connect(person, grbl);
    add(person, program("queued", 4));
    person.open(program("shown", 9));
    person.app().run("view.machine");
    person.frames(3);
    person.app().view_state().playback.time = 0.05;
    person.frames(2);
    run_next(person, 0, QueueState::done);
    person.frames(3);
    const auto now = person.app().look();
    EXPECT_NEAR(grbl.position()[0], 4.0, 0.01);
    EXPECT_FALSE(now.job_is_shown());
    EXPECT_NEAR(now.time(), 0.05, 1e-12);
    person.open(folder / "queued.ngc");
    EXPECT_TRUE(person.app().look().job_is_shown());
}

TEST_F(MachineQueue, BeginsOneByOneByAPersonsWord) {
    GrblBench grbl;
    Person person({1280, 800}, {}, jobs);
    connect(person, grbl);
    add(person, program("first", 2));
    add(person, slow_program("second"));
    add(person, program("third", 6));
    person.click("lower/queue/jobs/job2");
    person.click("lower/queue/later"); // first, third, second
    person.keep("machine-queue");
    EXPECT_FALSE(grbl.moving());
    const auto done = [&] {
        return std::ranges::count(person.app().look().queue, QueueState::done, &QueuedJob::state);
    };
    const auto run_next = [&](double x) {
        ASSERT_TRUE(person.live_until([&] { return machine_is(person, DriverState::idle); }));
        person.frames(2);
        const auto before = done();
        test::press_run(person, "lower/queue/queue_run_next");
        ASSERT_TRUE(person.live_until(
            [&] { return done() == before + 1 && !person.app().look().job.running; }, 60.0));
        EXPECT_NEAR(grbl.position()[0], x, 0.01);
        person.frames(20);
        EXPECT_FALSE(person.app().look().job.running); // the next waits for its word
    };
    run_next(2.0);
    run_next(6.0);
    const auto queued = person.app().look().queue;
    ASSERT_EQ(queued.size(), 3U);
    EXPECT_EQ(queued[1].name, "third");
    EXPECT_EQ(queued[1].state, QueueState::done);
    EXPECT_EQ(queued[2].state, QueueState::waiting);

    // A job that does not end well holds what is behind it until a person has decided.
    ASSERT_TRUE(person.live_until([&] { return machine_is(person, DriverState::idle); }));
    person.frames(2);
    test::press_run(person, "lower/queue/queue_run_next");
    ASSERT_TRUE(person.live_until([&] { return grbl.moving(); }));
    person.app().run("machine.emergency_stop");
    ASSERT_TRUE(person.live_until([&] { return !person.app().look().job.running; }));
    ASSERT_TRUE(person.live_until([&] { return person.app().look().queue[2].state == QueueState::held; }));
    person.frames(3);
    EXPECT_THAT(person.refusal("lower/queue/queue_run_next"),
                HasSubstr("second did not finish successfully"));
    person.keep("machine-queue-held");
    person.click("lower/queue/queue_remove_done");
    EXPECT_EQ(person.app().look().queue.size(), 1U);
    person.click("lower/queue/jobs/job2");
    person.click("lower/queue/release");
    EXPECT_EQ(person.app().look().queue[0].state, QueueState::waiting);
}

} // namespace
} // namespace millwright::panels
