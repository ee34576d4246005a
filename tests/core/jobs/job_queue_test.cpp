#include "core/jobs/job_queue.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/run_from_line.h"
#include "tests/support/jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace millwright::jobs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Job small_job(const std::string& name) {
    return text_job("G21 G90\n(" + name + ")\nG0 X1\nM2\n", name + ".ngc");
}

JobOutcome outcome_of(JobEnd end) {
    JobOutcome outcome;
    outcome.end = end;
    outcome.sentence = "it ended";
    outcome.log_file = "jobs/a-0001.jsonl";
    return outcome;
}

std::vector<std::string> names(const JobQueue& queue) {
    std::vector<std::string> all;
    for (const QueuedJob& job : queue.jobs()) {
        all.push_back(job.name + " " + std::string(to_text(job.state)));
    }
    return all;
}

/// The reason of the Error that `act` throws; empty if it throws none.
template <class Act> std::string queue_refusal(Act&& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

struct Three : testing::Test {
    JobQueue queue;
    QueuedJobId a = queue.add(small_job("a"));
    QueuedJobId b = queue.add(small_job("b"));
    QueuedJobId c = queue.add(small_job("c"));

    void run(QueuedJobId id, JobEnd end) {
        (void)queue.begin(id);
        queue.ended(outcome_of(end));
    }
};

TEST_F(Three, BeginInTheirOrderAndNeverTwoAtATime) {
    EXPECT_THAT(queue_refusal([&] { (void)queue.begin(b); }), HasSubstr("b is not the next job"));
    EXPECT_EQ(queue.begin(a).name, "a");
    EXPECT_FALSE(queue.next());
    EXPECT_THAT(queue_refusal([&] { (void)queue.begin(b); }), HasSubstr("b is not the next job"));
    EXPECT_THAT(queue_refusal([&] { (void)queue.begin(a); }), HasSubstr("a is running"));
    queue.ended(outcome_of(JobEnd::done));
    EXPECT_EQ(queue.next()->id, b);
    run(b, JobEnd::done);
    run(c, JobEnd::done);
    EXPECT_FALSE(queue.next());
    EXPECT_THAT(names(queue), ElementsAre("a done", "b done", "c done"));
    queue.remove_done();
    EXPECT_TRUE(queue.jobs().empty());
}

TEST_F(Three, AreHeldByOneThatDoesNotEndWell) {
    for (const JobEnd end : {JobEnd::fault, JobEnd::stopped, JobEnd::cancelled}) {
        run(a, end);
        EXPECT_FALSE(queue.next());
        EXPECT_EQ(queue.held()->id, a);
        EXPECT_EQ(queue.held()->end, end);
        EXPECT_EQ(queue.held()->sentence, "it ended");
        EXPECT_THAT(queue_refusal([&] { (void)queue.begin(b); }), HasSubstr("is not the next job"));
        EXPECT_THAT(queue_refusal([&] { (void)queue.begin(a); }), HasSubstr("a is held"));
        queue.release(a); // a person has looked at the machine
        EXPECT_EQ(queue.next()->id, a);
    }
    run(a, JobEnd::fault);
    queue.remove(a);
    EXPECT_EQ(queue.next()->id, b);
}

TEST_F(Three, AreHeldByOneThatThrows) {
    const auto refuses = [](const Job&) -> JobOutcome { throw Error("beyond its travel"); };
    EXPECT_THROW((void)queue.run(a, refuses), Error);
    EXPECT_EQ(queue.held()->sentence, "beyond its travel");
    queue.release(a);
    EXPECT_THROW((void)queue.run(a, [](const Job&) -> JobOutcome { throw Cancelled(); }), Cancelled);
    EXPECT_EQ(queue.held()->id, a);
}

/// What became of a job is not known by the reason why it could not go on.
TEST_F(Three, KeepWhatIsKnownOfAJobThatCannotGoOn) {
    run(a, JobEnd::fault);
    for (const char* why : {"the position is in doubt", "nobody answers"}) {
        queue.release(a);
        EXPECT_THROW((void)queue.run(a, [why](const Job&) -> JobOutcome { throw Error(why); }), Error);
        const QueuedJob held = queue.jobs().front();
        EXPECT_EQ(held.state, QueueState::held);
        EXPECT_EQ(held.end, JobEnd::fault);
        EXPECT_EQ(held.log_file, "jobs/a-0001.jsonl");
        EXPECT_EQ(held.sentence, std::string("it ended It could not continue: ") + why);
    }
}

TEST_F(Three, AreMovedWhileTheyWait) {
    (void)queue.begin(a);
    EXPECT_THAT(queue_refusal([&] { queue.move(a, 1); }), HasSubstr("only a waiting job"));
    queue.move(c, 0);
    EXPECT_THAT(names(queue), ElementsAre("a running", "c waiting", "b waiting"));
    queue.move(c, 99);
    EXPECT_THAT(names(queue), ElementsAre("a running", "b waiting", "c waiting"));
    EXPECT_THAT(queue_refusal([&] { queue.remove(a); }), HasSubstr("is running"));
    queue.remove(b);
    EXPECT_THAT(queue_refusal([&] { queue.move(b, 0); }), HasSubstr("no longer in the queue"));
    queue.ended(outcome_of(JobEnd::done));
    EXPECT_EQ(queue.next()->id, c);
}

TEST_F(Three, CanBeBegunInTheirMiddleAfterAFault) {
    std::string text = "G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\n";
    for (int n = 0; n < 20; ++n) {
        text += "X" + std::to_string(n) + "\n";
    }
    const Job whole = text_job(text + "M2\n", "d.ngc");
    const QueuedJobId d = queue.add(whole);
    for (const QueuedJobId id : {a, b, c}) {
        run(id, JobEnd::done);
    }
    run(d, JobEnd::fault);
    EXPECT_THAT(queue_refusal([&] { queue.load(d, small_job("d")); }),
                HasSubstr("not the program that was queued"));
    queue.load(d, job_from_line(whole, 15, {}));
    EXPECT_EQ(queue.held()->from_line, 15);
    queue.release(d);
    EXPECT_EQ(queue.begin(d).from_line, 15);
}

TEST(JobQueue, RunsJobsOnAMachine) {
    const test::TemporaryFolder folder;
    test::ManualClock clock;
    const Job job = test::dome_job();
    drivers::VirtualMachine machine(job.program->start, {}, clock);
    Dispatcher dispatcher(machine, clock, folder.path());
    JobQueue queue;
    const QueuedJobId first = queue.add(job);
    const QueuedJobId second = queue.add(job);
    const auto on_machine = [&](const Job& one) { return dispatcher.run(one, {}); };
    EXPECT_EQ(queue.run(first, on_machine).end, JobEnd::done);
    EXPECT_EQ(queue.jobs().front().log_file.filename(), "test-0001.jsonl");
    machine.emergency_stop();
    EXPECT_THROW((void)queue.run(second, on_machine), Error);
    EXPECT_THAT(queue.held()->sentence, HasSubstr("cannot start a job"));
}

TEST(JobQueue, OutlivesItsProgram) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "logs" / "queue.json";
    std::vector<QueuedJob> before;
    {
        JobQueue queue(file);
        const QueuedJobId a = queue.add(small_job("a"));
        (void)queue.add(small_job("b"));
        (void)queue.add(small_job("c"));
        queue.move(a, 1);
        EXPECT_EQ(queue.run(queue.next()->id, [](const Job&) { return outcome_of(JobEnd::done); }).end,
                  JobEnd::done);
        (void)queue.begin(a); // and here it is killed
        before = queue.jobs();
    }
    JobQueue queue(file);
    EXPECT_THAT(names(queue), ElementsAre("b done", "a held", "c waiting"));
    EXPECT_THAT(queue.held()->sentence, HasSubstr("its log shows"));
    for (QueuedJob& job : before) {
        job.has_program = false;
    }
    before[1].state = QueueState::held;
    before[1].sentence = queue.held()->sentence;
    EXPECT_EQ(queue.jobs(), before);

    const QueuedJobId a = queue.held()->id;
    queue.release(a);
    EXPECT_THAT(queue_refusal([&] { (void)queue.begin(a); }), HasSubstr("is not loaded"));
    queue.load(a, small_job("a"));
    EXPECT_EQ(queue.begin(a).name, "a");
    EXPECT_GT(queue.add(small_job("d")), before[2].id);
}

TEST(JobQueue, BelongsToOneProgramAtATime) {
    const test::TemporaryFolder folder;
    const JobQueue queue(folder.path() / "queue.json");
    EXPECT_THAT(queue_refusal([&] { JobQueue(folder.path() / "queue.json"); }),
                HasSubstr("in use by another"));
}

TEST(JobQueue, RefusesFilesThatAreNone) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "queue.json";
    const std::string good = R"({"format": "millwright-job-queue", "version": 1, "jobs": [
{"id": 1, "job": "a", "project": "a.ngc", "program_hash": "0", "blocks": 1, "from_line": 1, "state": "waiting"}]})";
    write_file(file, good);
    EXPECT_EQ(JobQueue(file).jobs().size(), 1u);
    for (const auto& [from, to] : {std::pair{"job-queue", "job-log"},
                                   {"\"version\": 1", "\"version\": 2"},
                                   {"waiting", "asleep"},
                                   {"\"id\": 1", "\"id\": 0"},
                                   {"\"job\": \"a\", ", ""},
                                   {"]}", "]"}}) {
        std::string bad = good;
        bad.replace(bad.find(from), std::string(from).size(), to);
        write_file(file, bad);
        EXPECT_THROW(JobQueue{file}, Error) << bad;
    }
}

/// Whatever people press: at most one job runs, none begins before those above it are done, and the file is
/// what the memory is.
TEST(JobQueue, KeepsItsRulesWhateverIsPressed) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "queue.json";
    std::mt19937 random(20261121);
    JobQueue queue(file);
    const auto any = [&] {
        const auto jobs = queue.jobs();
        return jobs.empty() ? QueuedJobId{} : jobs[random() % jobs.size()].id;
    };
    for (int n = 0; n < 2000; ++n) {
        (void)queue_refusal([&] {
            switch (random() % 8) {
            case 0:
                (void)queue.add(small_job(std::to_string(n)));
                break;
            case 1:
                queue.move(any(), static_cast<int>(random() % 5));
                break;
            case 2:
                queue.remove(any());
                break;
            case 3:
                queue.release(any());
                break;
            case 4:
                queue.remove_done();
                break;
            default:
                (void)queue.run(any(), [&](const Job&) {
                    int running = 0;
                    for (const QueuedJob& job : queue.jobs()) {
                        running += job.state == QueueState::running ? 1 : 0;
                        EXPECT_TRUE(running > 0 || job.state == QueueState::done);
                    }
                    EXPECT_EQ(running, 1);
                    return outcome_of(random() % 2 == 0 ? JobEnd::done : JobEnd::fault);
                });
            }
        });
    }
    EXPECT_GT(static_cast<int>(queue.add(small_job("last"))), 100);
}

} // namespace
} // namespace millwright::jobs
