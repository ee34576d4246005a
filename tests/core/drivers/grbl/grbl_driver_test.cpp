#include "core/drivers/grbl/grbl_driver.h"

#include "core/base/error.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/jobs/dispatcher.h"
#include "core/links/fault_link.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/serial_link.h"
#include "core/links/tcp.h"
#include "tests/core/links/reading.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <tuple>

namespace millwright::drivers {
namespace {

using testing::HasSubstr;

std::string zigzag_in_plane(int lines) {
    std::string text = "G21 G90 G94\n\nG1 F3000 (feed)\n";
    for (int n = 0; n < lines; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 10 : 0) + " Y" + std::to_string(n) + "\n";
    }
    return text + "M30\n";
}

Work work_of(const jobs::Job& job) {
    return {nullptr, nullptr, job.listing};
}

/// An emulated controller on a pseudo-terminal or TCP port, and a driver at the other end of a real link.
class GrblDriverBench {
public:
    explicit GrblDriverBench(const links::FaultSpec& faults = {},
                             bool tcp = false,
                             double speed = 20.0,
                             const GrblOptions& options = {},
                             emulators::GrblEmulatorOptions emulated = {.line_numbers = true}) {
        std::unique_ptr<links::Link> far_end;
        std::unique_ptr<links::Link> near_end;
        if (tcp) {
            auto listener = std::make_unique<links::TcpServer>(0);
            listener->open();
            near_end = std::make_unique<links::TcpLink>("127.0.0.1", listener->port());
            far_end = std::move(listener);
        } else {
            auto terminal = std::make_unique<links::PseudoTerminal>();
            terminal->open();
            near_end = std::make_unique<links::SerialLink>(terminal->path());
            far_end = std::move(terminal);
        }
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(far_end));
        server.emplace(std::move(links), clock, std::move(emulated), speed);
        driver.emplace(
            std::make_unique<links::FaultLink>(std::move(near_end), faults, links::WireEnd::host, clock),
            clock,
            options);
    }

    SteadyClock clock;
    std::optional<emulators::GrblServer> server;
    std::optional<GrblDriver> driver;

    [[nodiscard]] DriverState state() const { return driver->status().state; }
    void wait_for(DriverState wanted) const {
        test::wait_until([&] { return state() == wanted; });
        EXPECT_EQ(state(), wanted) << driver->status().message;
    }
    [[nodiscard]] emulators::Truth truth() {
        return server->with_controller([](const emulators::GrblEmulator& grbl) { return grbl.truth(); });
    }
    [[nodiscard]] bool moving() {
        return server->with_controller([](const emulators::GrblEmulator& grbl) { return grbl.moving(); });
    }
};

/// A link that changes one word on its way to the controller, once, as noise on a bare wire can.
class ChangingLink final : public links::Link {
public:
    ChangingLink(std::unique_ptr<links::Link> inner, std::string word, std::string by)
        : inner_(std::move(inner)), word_(std::move(word)), by_(std::move(by)) {}

    [[nodiscard]] std::string name() const override { return inner_->name(); }
    void open() override { inner_->open(); }
    void write(std::string_view bytes) override {
        std::string changed(bytes);
        const std::size_t at = changed.find(word_);
        if (at != std::string::npos && !done_.exchange(true)) {
            changed.replace(at, word_.size(), by_);
        }
        inner_->write(changed);
    }
    [[nodiscard]] std::string read() override { return inner_->read(); }
    void wait(double seconds) override { inner_->wait(seconds); }
    [[nodiscard]] std::optional<std::string> lost() const override { return inner_->lost(); }
    void close() noexcept override { inner_->close(); }

private:
    std::unique_ptr<links::Link> inner_;
    std::string word_, by_;
    std::atomic<bool> done_ = false;
};

class GrblDriverOver : public testing::TestWithParam<bool> {};

TEST_P(GrblDriverOver, RunsAJobAndLogsWhatWasExecuted) {
    const test::ScratchFolder scratch;
    GrblDriverBench bench({}, GetParam());
    const jobs::Job job = jobs::text_job(zigzag_in_plane(20), "zigzag.ngc");
    jobs::Dispatcher dispatcher(*bench.driver, bench.clock, scratch / "logs");
    const jobs::JobOutcome outcome = dispatcher.run(job, {});
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, 23);
    const emulators::Truth truth = bench.truth();
    ASSERT_EQ(truth.lines.size(), 23u);
    EXPECT_GE(truth.lines.back().executed, 0.0);
    const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
    EXPECT_EQ(log.start.driver, "grbl");
    EXPECT_EQ(log.executed_blocks(), 23);
    EXPECT_EQ(log.records.back().position[1], 19.0);
}

/// A person jogs away, sets a new zero and goes on; the box of the program goes with the zero.
TEST(GrblDriver, ChangesToolsWithinAJobAndLogsItsOwnLines) {
    const test::ScratchFolder scratch;
    GrblDriverBench bench;
    jobs::Job job = jobs::text_job("G21 G90 G94\nG0 Z5\nG1 X5 F3000\nT3 M6\nG1 X9\nZ1\nM30\n", "tools.ngc");
    jobs::Dispatcher dispatcher(*bench.driver, bench.clock, scratch / "logs");
    EXPECT_THROW((void)dispatcher.run(job, {}), Error) << "error 20";
    job.tool_change = ToolChangePlan{.way = ToolChangeWay::stop, .spin_up = 0.0};
    int step = 0;
    const jobs::JobOutcome outcome = dispatcher.run(job, {}, [&](const jobs::JobReport& report) {
        const DriverStatus& status = report.driver;
        if (!status.tool_change || !status.tool_change->waits || status.state != DriverState::holding) {
            return;
        }
        switch (++step) {
        case 1:
            return bench.driver->jog({kinematics::AxisPositions(Vec3(-30.0, 20.0, -25.0)), 100.0, 0.0});
        case 2:
            EXPECT_NEAR(status.position[0], -25.0, 0.01);
            return static_cast<void>(bench.driver->command("G10 L20 P0 Z0"));
        case 3:
            return dispatcher.resume();
        default:
            return;
        }
    });
    EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
    EXPECT_EQ(outcome.executed_blocks, 7);
    EXPECT_NEAR(outcome.position[2], -19.0, 0.01);
    const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
    std::vector<std::string> own;
    int waits = 0;
    for (const jobs::LogRecord& record : log.records) {
        waits += record.event == jobs::LogEvent::waiting ? 1 : 0;
        if (record.event == jobs::LogEvent::own) {
            own.push_back(record.text);
            EXPECT_EQ(record.executed_blocks, 3);
            EXPECT_EQ(record.line, 4);
        }
    }
    EXPECT_EQ(waits, 1) << "a jog is no new reason to wait";
    ASSERT_GE(own.size(), 8u);
    EXPECT_EQ(own[0], "M5");
    EXPECT_EQ(own[5], "G53G0Z5.0");
}

/// Grbl acknowledges a changed digit as any other; its reports show where the tool goes.
TEST(GrblDriver, StopsAMachineThatIsWhereNoLineSendsIt) {
    const test::ScratchFolder scratch;
    const auto run = [&](const std::string& word, const std::string& by, const std::string& program) {
        const SteadyClock clock;
        auto listener = std::make_unique<links::TcpServer>(0);
        listener->open();
        auto near_end = std::make_unique<links::TcpLink>("127.0.0.1", listener->port());
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(listener));
        emulators::GrblServer server(std::move(links), clock, {}, 1.0);
        GrblDriver driver(std::make_unique<ChangingLink>(std::move(near_end), word, by), clock);
        SteadyClock waiting;
        jobs::JobOutcome outcome =
            jobs::Dispatcher(driver, waiting, scratch / "logs").run(jobs::text_job(program, "part.ngc"), {});
        const double x =
            server.with_controller([](const emulators::GrblEmulator& grbl) { return grbl.position()[0]; });
        const bool moving =
            server.with_controller([](const emulators::GrblEmulator& grbl) { return grbl.moving(); });
        EXPECT_FALSE(moving);
        return std::tuple(std::move(outcome), driver.status(), x);
    };
    const std::string program = "G21 G90\nG1 X19.833 F3000\nX0\nX19.5\nX1\nX10\nM30\n";
    const auto [outcome, status, x] = run("X19.833", "X199.833", program);
    EXPECT_EQ(outcome.end, jobs::JobEnd::fault);
    EXPECT_THAT(outcome.sentence, HasSubstr("Fault: the machine reports X "));
    EXPECT_THAT(outcome.sentence, HasSubstr("but the program never goes beyond X 19.833"));
    EXPECT_EQ(status.state, DriverState::alarm);
    EXPECT_THAT(status.message, HasSubstr("a line was altered on its way"));
    EXPECT_GT(x, 20.8);
    EXPECT_LT(x, 80.0); // F3000 is 50 mm/s: seen within half a second
    EXPECT_EQ(jobs::read_job_log(outcome.log_file).end(), jobs::JobEnd::fault);

    const auto [last, at_rest, end] = run("X10", "X100", "G21 G90\nG1 X20 F9000\nX10\nM30\n");
    EXPECT_EQ(last.end, jobs::JobEnd::fault) << last.sentence; // also where it comes to rest there
    EXPECT_EQ(at_rest.state, DriverState::alarm);
    EXPECT_GT(end, 21.0);

    const auto [offset, ready, there] = run(
        "nothing", "", "G21 G90\nG92 X500\nG1 X510 F3000\nG2 X510 I-5\nG91\nG1 X-3\nG53 G0 X2\nG92.1\nM30\n");
    EXPECT_EQ(offset.end, jobs::JobEnd::done) << offset.sentence;
    EXPECT_EQ(ready.state, DriverState::idle);
    EXPECT_EQ(there, 2.0);
}

TEST_P(GrblDriverOver, HoldsResumesAndStops) {
    GrblDriverBench bench({}, GetParam());
    bench.driver->connect();
    bench.driver->start(work_of(jobs::text_job(zigzag_in_plane(200), "zigzag.ngc")));
    test::wait_until([&] { return bench.driver->status().position[1] > 5.0; });
    bench.driver->hold();
    bench.wait_for(DriverState::holding);
    test::wait_until([&] { return !bench.moving(); });
    EXPECT_FALSE(bench.moving());
    bench.driver->resume();
    test::wait_until([&] { return bench.driver->status().position[1] > 15.0; });
    bench.driver->stop();
    bench.wait_for(DriverState::stopped);
    EXPECT_FALSE(bench.moving());
    const double travelled = bench.truth().travelled;
    bench.driver->close();
    EXPECT_EQ(bench.truth().travelled, travelled);
}

INSTANTIATE_TEST_SUITE_P(RealLinks, GrblDriverOver, testing::Values(false, true));

TEST(GrblDriver, TellsThatNobodyAnswers) {
    links::PseudoTerminal nobody;
    nobody.open();
    SteadyClock clock;
    GrblDriver driver(std::make_unique<links::SerialLink>(nobody.path()), clock, {.greeting_time = 0.2});
    try {
        driver.connect();
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no Grbl controller answers"));
    }
    EXPECT_EQ(driver.status().state, DriverState::disconnected);
}

TEST(GrblDriver, ReadsSettingsAndPosition) {
    GrblDriverBench bench;
    bench.driver->connect();
    const GrblReadout readout = bench.driver->readout();
    EXPECT_EQ(readout.version, "1.1h");
    EXPECT_EQ(readout.settings.at(110), 3000.0);
    EXPECT_EQ(bench.driver->status().position.size(), 3);
    EXPECT_TRUE(bench.driver->capabilities().manual.jog);
}

TEST(GrblDriver, GoesIntoAlarmWhenTheLinkBreaksAndComesBackOnlyWhenAsked) {
    GrblDriverBench bench(
        {.disconnect = 6000, .toward_controller = false}); // the greeting takes far less, 2000 answers more
    bench.driver->connect();
    bench.driver->start(work_of(jobs::text_job(zigzag_in_plane(2000), "zigzag.ngc")));
    bench.wait_for(DriverState::alarm);
    EXPECT_THAT(bench.driver->status().message, HasSubstr("the link was lost"));
    EXPECT_THROW(bench.driver->start(work_of(jobs::text_job("G0 X0\n", "x"))), Error);
    test::wait_until([&] { return !bench.moving(); });
    const std::size_t lines = bench.truth().lines.size();
    bench.driver->reset();
    bench.wait_for(DriverState::idle);
    EXPECT_EQ(bench.truth().lines.size(), lines);
}

TEST(GrblDriver, LeavesAMachineThatStillMovesWhenTheLinkIsMadeAgainToItselfUntilItIsStopped) {
    GrblDriverBench bench({.disconnect = 6000, .toward_controller = false},
                          false,
                          1.0,
                          {.poll_interval = 0.01, .patience = 60.0});
    bench.driver->connect();
    bench.driver->start(
        work_of(jobs::text_job("G21 G90 G94\nG1 F60 X900\nX0\nM30\n", "slow.ngc"))); // half an hour
    bench.wait_for(DriverState::alarm);
    ASSERT_TRUE(bench.driver->status().link_lost);
    ASSERT_TRUE(bench.moving());
    bench.driver->reset(); // makes the link again
    EXPECT_TRUE(bench.moving());
    EXPECT_EQ(bench.driver->status().state, DriverState::running);
    EXPECT_THROW(bench.driver->start(work_of(jobs::text_job("G0 X0\n", "next.ngc"))), Error);
    EXPECT_TRUE(bench.moving());
    bench.driver->stop();
    bench.wait_for(DriverState::idle);
    EXPECT_FALSE(bench.moving());
}

TEST(GrblDriver, HoldsAtOnceWhileTheLogWaitsForItsDisk) {
    GrblDriverBench bench;
    bench.driver->connect();
    std::atomic<bool> waits = false;
    std::atomic<bool> held = false;
    Work work = work_of(jobs::text_job(zigzag_in_plane(2000), "zigzag.ngc"));
    work.ahead = [&](int wanted) {
        constexpr int free_blocks = 60;
        if (wanted > free_blocks) {
            waits = true;
            test::wait_until([&] { return held.load(); });
            waits = false;
        }
        return wanted;
    };
    bench.driver->start(std::move(work));
    test::wait_until([&] { return waits.load(); });
    bench.driver->hold();
    EXPECT_TRUE(waits) << "the hold waited for the disk";
    held = true;
    bench.wait_for(DriverState::holding);
    bench.driver->emergency_stop();
}

TEST(GrblDriver, GoesIntoAlarmWhenALimitSwitchIsHit) {
    GrblDriverBench bench;
    bench.driver->connect();
    bench.driver->start(work_of(jobs::text_job(zigzag_in_plane(2000), "zigzag.ngc")));
    test::wait_until([&] { return bench.driver->status().position[1] > 3.0; });
    bench.server->with_controller([](emulators::GrblEmulator& grbl) { grbl.raise_alarm(); });
    bench.wait_for(DriverState::alarm);
    test::wait_until([&] { return !bench.driver->status().message.empty(); });
    EXPECT_THAT(bench.driver->status().message, HasSubstr("alarm 1: a limit switch was triggered"));
    bench.driver->reset();
    bench.wait_for(DriverState::idle);
    EXPECT_FALSE(bench.moving());
}

/// Over a pseudo-terminal: met, driven with its rotary axes, refused beyond them, and named in the log.
TEST(GrblDriver, RunsJobsOfFiveAxesOnOtherFirmware) {
    const std::string program = "G21 G90 G94\nG1 X10 A90 B-45 F3000\nX0 A-90 B45\nG0 A0 B0\nM30\n";
    for (const emulators::EmulatedFirmware firmware :
         {emulators::EmulatedFirmware::grblhal, emulators::EmulatedFirmware::fluidnc}) {
        const test::ScratchFolder scratch;
        GrblDriverBench bench({}, false, 5.0, {}, {.firmware = firmware, .axes = "XYZAB"});
        jobs::Dispatcher dispatcher(*bench.driver, bench.clock, scratch / "logs");
        const jobs::JobOutcome outcome = dispatcher.run(jobs::text_job(program, "five.ngc"), {});
        EXPECT_EQ(outcome.end, jobs::JobEnd::done) << outcome.sentence;
        const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
        EXPECT_EQ(log.start.firmware,
                  firmware == emulators::EmulatedFirmware::grblhal ? "grblHAL 1.1f (20240817)"
                                                                   : "FluidNC v3.7.12");
        EXPECT_EQ(log.start.axes.size(), 5U);
        EXPECT_EQ(log.executed_blocks(), log.start.blocks);

        const Capabilities can = bench.driver->capabilities();
        ASSERT_EQ(can.axes.size(), 5U);
        EXPECT_EQ(can.axes[4].letter, 'B');
        EXPECT_EQ(can.axes[4].kind, kinematics::AxisKind::rotary);
        try {
            (void)dispatcher.run(jobs::text_job("G21 G90\nG0 C10\nM30\n", "six.ngc"), {});
            FAIL();
        } catch (const Error& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr("the program moves C, but the machine has only X, Y, Z, A and B"));
        }
    }
}

TEST(GrblDriver, JogsWhileTheButtonIsHeld) {
    GrblDriverBench bench({}, false, 1.0);
    bench.driver->connect();
    Jog jog;
    jog.way = kinematics::AxisPositions::Zero(3);
    jog.way[0] = 50.0;
    jog.speed = 30.0;
    bench.driver->jog(jog);
    test::wait_until([&] { return bench.driver->status().position[0] > 1.0; });
    bench.driver->stop_jog();
    bench.wait_for(DriverState::idle);
    EXPECT_FALSE(bench.moving());
    EXPECT_LT(bench.driver->status().position[0], 40.0);
}

} // namespace
} // namespace millwright::drivers
