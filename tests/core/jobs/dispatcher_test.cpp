#include "core/jobs/dispatcher.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/job_log.h"
#include "core/jobs/recovery.h"
#include "core/jobs/run_from_line.h"
#include "core/posts/post_file.h"
#include "core/posts/release.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::jobs {
namespace {

using kinematics::AxisPositions;
using ::testing::HasSubstr;

struct DispatcherBench {
    test::TemporaryFolder folder;
    test::ManualClock clock;
    Job job = test::dome_job();
    drivers::VirtualMachine machine{job.program->start, {}, clock};
    Dispatcher dispatcher{machine, clock, folder.path() / "logs"};

    [[nodiscard]] int blocks() const { return job.program->block_count(); }
};

std::vector<LogEvent> events(const ReadLog& log) {
    std::vector<LogEvent> result;
    for (const LogRecord& record : log.records) {
        if (record.event != LogEvent::executed) {
            result.push_back(record.event);
        }
    }
    return result;
}

TEST(Dispatcher, RunsAJobToItsEndAndLogsIt) {
    DispatcherBench bench;
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {});
    EXPECT_EQ(outcome.end, JobEnd::done);
    EXPECT_EQ(outcome.executed_blocks, bench.blocks());
    EXPECT_EQ(outcome.position, bench.job.program->blocks.back().target);
    const ReadLog log = read_job_log(outcome.log_file);
    EXPECT_EQ(log.end(), JobEnd::done);
    EXPECT_EQ(log.executed_blocks(), bench.blocks());
    EXPECT_EQ(log.start.program_hash, program_hash(bench.job.listing->text));
    EXPECT_NEAR(log.start.planned_time, outcome.elapsed, 0.05);
    int before = 0;
    for (const LogRecord& record : log.records) {
        EXPECT_GE(record.executed_blocks, before);
        before = record.executed_blocks;
    }
}

TEST(Dispatcher, TellsHowFarTheJobIs) {
    DispatcherBench bench;
    std::vector<JobReport> reports;
    std::vector<double> fractions;
    const Progress progress([&](const Progress::Report& report) { fractions.push_back(report.fraction); },
                            {});
    (void)bench.dispatcher.run(
        bench.job, progress, [&](const JobReport& report) { reports.push_back(report); });
    ASSERT_GT(reports.size(), 100U);
    EXPECT_EQ(reports.back().driver.executed_blocks, reports.back().blocks);
    EXPECT_DOUBLE_EQ(fractions.back(), 1.0);
    EXPECT_NEAR(reports[reports.size() / 2].driver.planned_time, reports[reports.size() / 2].elapsed, 1e-6);
}

TEST(Dispatcher, LogsWhatTheMachineWaitsFor) {
    DispatcherBench bench;
    const auto router = std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz"));
    const Job job = planned_job("G21 G90\nG1 X10 F6000\nM0\nX20\nT4 M6\nX30\nM30\n", "part.ngc", router);
    drivers::VirtualMachine machine(job.program->start, {}, bench.clock, router);
    Dispatcher dispatcher(machine, bench.clock, bench.folder.path() / "logs");
    std::vector<std::string> reasons;
    const JobOutcome outcome = dispatcher.run(job, {}, [&](const JobReport& report) {
        if (report.driver.state == drivers::DriverState::holding) {
            reasons.push_back(report.driver.message);
            dispatcher.resume();
        }
    });
    EXPECT_EQ(outcome.end, JobEnd::done);
    EXPECT_THAT(reasons,
                ::testing::ElementsAre("program stop at line 3: M0", "change to tool 4 at line 5: M6"));
    const ReadLog log = read_job_log(outcome.log_file);
    EXPECT_THAT(events(log),
                ::testing::ElementsAre(
                    LogEvent::waiting, LogEvent::resume, LogEvent::waiting, LogEvent::resume, LogEvent::end));
    const auto waiting = std::ranges::find(log.records, LogEvent::waiting, &LogRecord::event);
    EXPECT_EQ(waiting->text, "program stop at line 3: M0");
    EXPECT_EQ(waiting->line, 3);
    EXPECT_EQ(waiting->executed_blocks, 1);
    EXPECT_EQ(waiting->position, job.program->blocks[0].target);
}

TEST(Dispatcher, LogsTheSwitchForOptionalStops) {
    DispatcherBench bench;
    const auto router = std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz"));
    const Job job = planned_job("G21 G90\nG1 X10 F6000\nM1\nX20\nM30\n", "part.ngc", router);
    drivers::VirtualMachine machine(job.program->start, {}, bench.clock, router);
    Dispatcher dispatcher(machine, bench.clock, bench.folder.path() / "logs");
    bool on = false;
    const JobOutcome outcome = dispatcher.run(job, {}, [&](const JobReport& report) {
        if (!std::exchange(on, true)) {
            dispatcher.set_optional_stop(true);
        }
        if (report.driver.state == drivers::DriverState::holding) {
            dispatcher.resume();
        }
    });
    EXPECT_THAT(
        events(read_job_log(outcome.log_file)),
        ::testing::ElementsAre(LogEvent::optional_stop, LogEvent::waiting, LogEvent::resume, LogEvent::end));
}

/// A program of the router, in the words of Grbl.
Job grbl_router_job() {
    const auto router = test::machine("router-xyz");
    program::Program program = test::empty_program(router);
    for (int n = 1; n <= 100; ++n) {
        test::add_move(program, AxisPositions(Vec3(n % 2 == 0 ? 10.0 : 0.0, n, 0.0)), 0.5);
    }
    test::add_block(program, program::BlockKind::end);
    posts::ReleasedText text = posts::release(program, router, posts::read_post("assets/posts/grbl.json"));
    Job job;
    job.name = "router";
    job.machine = std::make_shared<const kinematics::MachineModel>(router);
    job.program = std::make_shared<const program::Program>(std::move(text.program));
    job.listing = std::make_shared<const program::Listing>(std::move(text.listing));
    return job;
}

TEST(Dispatcher, TellsHowFarAControllerIsThatPlansForItself) {
    const test::TemporaryFolder folder;
    test::GrblWire wire({}, {.line_numbers = true});
    test::WireClock clock(wire, wire.now + 600.0);
    test::WireDriver driver(wire);
    const Job job = grbl_router_job();
    std::vector<double> fractions;
    std::vector<JobReport> reports;
    const JobOutcome outcome =
        Dispatcher(driver, clock, folder.path())
            .run(job,
                 Progress([&](const Progress::Report& now) { fractions.push_back(now.fraction); }, {}),
                 [&](const JobReport& report) { reports.push_back(report); });
    ASSERT_EQ(outcome.end, JobEnd::done) << outcome.sentence;
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
    EXPECT_DOUBLE_EQ(fractions.back(), 1.0);
    // All moves take the same time but the first and the last, which begin and end at rest.
    const auto half = std::ranges::find_if(
        reports, [](const JobReport& report) { return 2 * report.driver.executed_blocks >= report.blocks; });
    ASSERT_NE(half, reports.end());
    const double done =
        half->driver.position[1] / 100.0; // Y tells the move, some of which are not proven yet
    EXPECT_GT(done, 0.5);
    EXPECT_NEAR(half->driver.planned_time / half->planned_time, done, 0.02);
    EXPECT_NEAR(half->elapsed / reports.back().elapsed, 0.5, 0.1);
}

TEST(Dispatcher, LogsHoldResumeAndStopWithTimeAndPosition) {
    DispatcherBench bench;
    int looks = 0;
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const JobReport&) {
        ++looks;
        if (looks == 100) {
            bench.dispatcher.hold();
        } else if (looks == 200) {
            bench.dispatcher.resume();
        } else if (looks == 300) {
            bench.dispatcher.stop();
        }
    });
    EXPECT_EQ(outcome.end, JobEnd::stopped);
    EXPECT_THAT(outcome.sentence, HasSubstr("stopped"));
    const ReadLog log = read_job_log(outcome.log_file);
    EXPECT_EQ(events(log), (std::vector{LogEvent::hold, LogEvent::resume, LogEvent::stop, LogEvent::end}));
    EXPECT_EQ(log.end(), JobEnd::stopped);
    EXPECT_LT(outcome.executed_blocks, bench.blocks());
    EXPECT_EQ(log.executed_blocks(), outcome.executed_blocks);
    EXPECT_LT((log.records.back().position - bench.machine.status().position).norm(), 1e-5);
}

TEST(Dispatcher, StopsTheMachineWhenItsProgressIsCancelled) {
    DispatcherBench bench;
    std::stop_source source;
    int looks = 0;
    const JobOutcome outcome =
        bench.dispatcher.run(bench.job, Progress({}, source.get_token()), [&](const JobReport&) {
            if (++looks == 150) {
                source.request_stop();
            }
        });
    EXPECT_EQ(outcome.end, JobEnd::cancelled);
    EXPECT_EQ(bench.machine.status().state, drivers::DriverState::stopped);
    EXPECT_EQ(read_job_log(outcome.log_file).end(), JobEnd::cancelled);
}

TEST(Dispatcher, DoesNotStartWhatIsCancelledBefore) {
    DispatcherBench bench;
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW((void)bench.dispatcher.run(bench.job, Progress({}, source.get_token())), Cancelled);
    EXPECT_EQ(bench.machine.status().position, bench.job.program->start);
}

TEST(Dispatcher, ReportsAFaultAndWhatWasExecutedForCertain) {
    DispatcherBench bench;
    int looks = 0;
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const JobReport&) {
        if (++looks == 400) {
            bench.machine.emergency_stop();
        }
    });
    EXPECT_EQ(outcome.end, JobEnd::fault);
    EXPECT_THAT(outcome.sentence, HasSubstr("emergency stop"));
    const ReadLog log = read_job_log(outcome.log_file);
    EXPECT_EQ(events(log), (std::vector{LogEvent::fault, LogEvent::end}));
    EXPECT_EQ(log.end(), JobEnd::fault);
    EXPECT_THAT(job_story(outcome.log_file).sentence, HasSubstr("emergency stop; "));
    EXPECT_THROW((void)bench.dispatcher.run(bench.job, {}), Error); // nothing before the reset
}

TEST(Dispatcher, TakesALostLinkForAFaultWithTheLastKnownPosition) {
    DispatcherBench bench;
    kinematics::AxisPositions last;
    int looks = 0;
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const JobReport& report) {
        last = report.driver.position;
        if (++looks == 400) {
            bench.machine.close();
        }
    });
    EXPECT_EQ(outcome.end, JobEnd::fault);
    EXPECT_THAT(outcome.sentence, HasSubstr("the link was lost"));
    EXPECT_EQ(outcome.position, last);
}

TEST(Dispatcher, RunsAJobAgainFromWhereTheMachineWasStopped) {
    DispatcherBench bench;
    int looks = 0;
    (void)bench.dispatcher.run(bench.job, {}, [&](const JobReport&) {
        if (++looks == 300) {
            bench.dispatcher.stop();
        }
    });
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {});
    EXPECT_EQ(outcome.end, JobEnd::done);
    EXPECT_EQ(outcome.log_file.filename(), "test-0002.jsonl");
}

TEST(Dispatcher, LogsTheLineThatAnApproachLeadsTo) {
    DispatcherBench bench;
    constexpr int from = 40;
    const Job rest = job_from_line(bench.job, from, {});
    drivers::VirtualMachine machine(rest.program->start, {}, bench.clock);
    const ReadLog log =
        read_job_log(Dispatcher(machine, bench.clock, bench.folder.path() / "logs").run(rest, {}).log_file);
    ASSERT_GT(log.records.size(), 10U);
    int before = from;
    for (const LogRecord& record : log.records) {
        EXPECT_GE(record.line, before);
        before = record.line;
    }
    EXPECT_GT(before, from);
}

TEST(Dispatcher, MovesNothingIfTheLogFolderCannotBeMade) {
    DispatcherBench bench;
    write_file(bench.folder.path() / "logs", "in the way");
    EXPECT_THROW((void)bench.dispatcher.run(bench.job, {}), Error);
    bench.clock.wait(10.0);
    EXPECT_EQ(bench.machine.status().position, bench.job.program->start);
}

TEST(Dispatcher, MovesNothingIfThePreflightFindsSomething) {
    DispatcherBench bench;
    program::Program program = *bench.job.program;
    program.blocks[9].target[1] = 1e4;
    program.blocks[9].target[2] = -1e4;
    try {
        (void)bench.dispatcher.run(test::job_of(program), {});
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("axis Y would move to 10000.000"));
        EXPECT_THAT(error.what(), HasSubstr("; and 1 more"));
        EXPECT_THAT(error.diagnostic().message, HasSubstr("; and 1 more")); // not in the advice
    }
    EXPECT_FALSE(std::filesystem::exists(bench.folder.path() / "logs"));
    EXPECT_EQ(bench.machine.status().state, drivers::DriverState::disconnected);
}

TEST(Dispatcher, StopsTheMachineIfItsListenerFails) {
    DispatcherBench bench;
    int looks = 0;
    const auto failing = [&](const JobReport&) {
        if (++looks == 300) {
            throw Error("the window is gone");
        }
    };
    EXPECT_THROW((void)bench.dispatcher.run(bench.job, {}, failing), Error);
    EXPECT_EQ(bench.machine.status().state, drivers::DriverState::stopped);
    const ReadLog log = read_job_log(bench.folder.path() / "logs" / "test-0001.jsonl");
    EXPECT_EQ(log.end(), JobEnd::fault);
    EXPECT_EQ(log.executed_blocks(), bench.machine.status().executed_blocks);
}

TEST(Dispatcher, RunsOneJobAtATime) {
    DispatcherBench bench;
    int looks = 0;
    const JobOutcome outcome = bench.dispatcher.run(bench.job, {}, [&](const JobReport&) {
        if (++looks == 10) {
            EXPECT_THROW((void)bench.dispatcher.run(bench.job, {}), Error);
        }
    });
    EXPECT_EQ(outcome.end, JobEnd::done);
}

/// A driver that says it is idle before everything was executed.
class EarlyDriver final : public drivers::Driver {
public:
    explicit EarlyDriver(kinematics::AxisPositions position) { status_.position = std::move(position); }
    [[nodiscard]] std::string name() const override { return "early"; }
    [[nodiscard]] drivers::DriverStatus status() const override { return status_; }
    void connect() override { status_.state = drivers::DriverState::idle; }
    void start(drivers::Work work) override { status_.executed_blocks = work.program->block_count() - 1; }
    void hold() override {}
    void resume() override {}
    void stop() override {}
    void emergency_stop() override {}
    void reset() override {}
    void close() noexcept override {}

private:
    drivers::DriverStatus status_;
};

TEST(Dispatcher, NeverReportsDoneUnlessTheDriverExecutedEveryBlock) {
    const test::TemporaryFolder folder;
    test::ManualClock clock;
    const Job job = test::dome_job();
    EarlyDriver driver(job.program->start);
    driver.connect();
    const JobOutcome outcome = Dispatcher(driver, clock, folder.path()).run(job, {});
    EXPECT_EQ(outcome.end, JobEnd::fault);
    EXPECT_EQ(outcome.executed_blocks, job.program->block_count() - 1);
    EXPECT_THAT(outcome.sentence, HasSubstr("the program did not finish"));
}

} // namespace
} // namespace millwright::jobs
