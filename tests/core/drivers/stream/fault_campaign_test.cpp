// Many jobs over a coordinate stream whose link fails, to an emulated machine. Nothing comes back over such a
// link, so a lost byte is seen by the machine alone. What must hold in each run:
//   no sample leaves after a job has ended, whatever ended it, and the machine stands where the last one was;
//   where the link changes nothing, each axis keeps its limits from sample to sample, holds and stops
//   included,
//     and the machine ends where the driver says;
//   the log is consistent with itself and with the outcome, and claims nothing that was not sent.
#include "tests/core/drivers/fault_campaign.h"

#include "core/base/error.h"
#include "core/drivers/stream/stream_driver.h"
#include "core/emulators/stream/stream_emulator.h"
#include "core/jobs/dispatcher.h"
#include "core/links/fault_link.h"
#include "tests/support/jobs.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>

namespace millwright::drivers {
namespace {

using kinematics::AxisPositions;
using test::pick;
using test::Random;

enum class StreamFault { none, drop, garble, duplicate, disconnect, stall };
constexpr int stream_fault_count = 6;
constexpr double stream_period = 0.02; // s

/// A link into this program, at the far end of which the machine listens; its time is that of the samples.
class StreamWire final : public links::Link {
public:
    explicit StreamWire(const links::FaultSpec& faults) : wire_(faults, links::WireEnd::controller) {}

    [[nodiscard]] std::string name() const override { return "wire"; }
    void open() override {}
    void write(std::string_view bytes) override {
        const std::scoped_lock lock(mutex_);
        written_ += bytes;
        if (!wire_.disconnected()) {
            wire_.send(bytes, time_);
        }
        time_ += stream_period;
        machine_.receive(wire_.arrived(time_));
        machine_.advance(stream_period);
    }
    [[nodiscard]] std::string read() override { return {}; }
    void wait(double) override { std::this_thread::yield(); }
    [[nodiscard]] std::optional<std::string> lost() const override {
        const std::scoped_lock lock(mutex_);
        return wire_.disconnected() ? std::optional<std::string>("the plug was pulled") : std::nullopt;
    }
    void close() noexcept override {}

    /// What was written so far, and what became of it.
    [[nodiscard]] std::string written() const {
        const std::scoped_lock lock(mutex_);
        return written_;
    }
    /// The machine, once it has gone to all that came.
    [[nodiscard]] const emulators::StreamEmulator& settled() {
        const std::scoped_lock lock(mutex_);
        constexpr double long_enough = 10.0; // s
        machine_.advance(long_enough);
        return machine_;
    }

private:
    mutable std::mutex mutex_;
    links::FaultyWire wire_;
    double time_ = 0.0;
    std::string written_;
    emulators::StreamEmulator machine_;
};

links::FaultSpec faults_of(StreamFault kind, Random& random, std::uint64_t seed) {
    links::FaultSpec spec;
    spec.seed = seed;
    const double rate = 0.0005 * (1 + pick(random, 20));
    const std::int64_t moment = 60 + pick(random, 6000); // bytes; the heading is through
    switch (kind) {
    case StreamFault::none:
        break;
    case StreamFault::drop:
        spec.drop = rate;
        break;
    case StreamFault::garble:
        spec.garble = rate;
        break;
    case StreamFault::duplicate:
        spec.duplicate = rate;
        break;
    case StreamFault::disconnect:
        spec.disconnect = moment;
        break;
    case StreamFault::stall:
        spec.stall = moment;
        break;
    }
    return spec;
}

jobs::Job random_job(const kinematics::MachineModel& router, Random& random) {
    program::Program program = test::empty_program(router);
    const int moves = 3 + pick(random, 10);
    for (int n = 0; n < moves; ++n) {
        const Vec3 target(pick(random, 30), pick(random, 30), -pick(random, 5));
        test::add_move(program, AxisPositions(target), 0.1 * pick(random, 5));
    }
    test::add_block(program, program::BlockKind::end);
    jobs::Job job = test::job_of(std::move(program));
    job.machine = std::make_shared<const kinematics::MachineModel>(router);
    return job;
}

class StreamCampaignRun {
public:
    StreamCampaignRun(std::uint64_t seed, const kinematics::MachineModel& router, std::filesystem::path logs)
        : random_(seed), kind_(static_cast<StreamFault>(seed % stream_fault_count)), router_(router),
          logs_(std::move(logs)), job_(random_job(router, random_)) {
        job_.name = fmt::format("run-{}", seed);
        auto wire = std::make_unique<StreamWire>(faults_of(kind_, random_, seed));
        wire_ = wire.get();
        driver_ = std::make_unique<StreamDriver>(
            std::move(wire),
            clock_,
            std::make_shared<const kinematics::MachineModel>(router_),
            job_.program->start,
            StreamOptions{.period = stream_period, .decimals = 6, .paced = false});
    }

    /// What is wrong; empty: nothing.
    std::string run() {
        driver_->connect();
        jobs::Dispatcher dispatcher(*driver_, clock_, logs_);
        try {
            outcome_ = dispatcher.run(
                job_, {}, [&](const jobs::JobReport& report) { act(dispatcher, report.driver); });
        } catch (const Error& error) {
            check_refusal(error);
            return wrong_;
        }
        check_log();
        check_quiet();
        check_machine();
        std::filesystem::remove(outcome_.log_file);
        return wrong_;
    }
    [[nodiscard]] bool done() const { return outcome_.end == jobs::JobEnd::done; }

private:
    /// Real time passes as fast as the computer lets it: whoever waits gives way.
    class HastyClock final : public Clock {
    public:
        [[nodiscard]] double now() const override { return time_; }
        void wait(double seconds) override {
            time_ = time_ + seconds;
            std::this_thread::yield();
        }

    private:
        std::atomic<double> time_ = 0.0;
    };

    Random random_;
    StreamFault kind_;
    const kinematics::MachineModel& router_;
    std::filesystem::path logs_;
    jobs::Job job_;
    HastyClock clock_;
    std::unique_ptr<StreamDriver> driver_;
    StreamWire* wire_ = nullptr; ///< the driver's
    jobs::JobOutcome outcome_;
    std::string wrong_;

    void wrong(const std::string& what) {
        if (wrong_.empty()) {
            wrong_ = fmt::format("kind {}: {} ({})", static_cast<int>(kind_), what, outcome_.sentence);
        }
    }

    void act(jobs::Dispatcher& dispatcher, const DriverStatus& now) {
        if (now.state == DriverState::holding && pick(random_, 20) == 0) {
            dispatcher.resume();
        }
        switch (now.state == DriverState::running ? pick(random_, 400) : -1) {
        case 0:
        case 1:
            dispatcher.hold();
            break;
        case 2:
            dispatcher.stop();
            break;
        case 3:
            driver_->emergency_stop();
            break;
        case 4:
            try {
                dispatcher.set_single_block(true);
            } catch (const Error&) {
                // it has ended since
            }
            break;
        default:
            break;
        }
    }

    /// The plug may be out before the job begins: then it must not begin.
    void check_refusal(const Error& error) {
        if (kind_ != StreamFault::disconnect || driver_->status().state != DriverState::alarm) {
            wrong(fmt::format("refused: {}", error.what()));
        }
        if (driver_->status().executed_blocks > 0) {
            wrong("refused, and yet something was executed");
        }
    }

    void check_log() {
        const jobs::ReadLog log = jobs::read_job_log(outcome_.log_file);
        int before = 0;
        for (const jobs::LogRecord& record : log.records) {
            if (record.executed_blocks < before) {
                wrong("the log takes something back");
            }
            before = record.executed_blocks;
        }
        if (log.end() != outcome_.end || log.executed_blocks() != outcome_.executed_blocks) {
            wrong("the log does not end as the job did");
        }
        if (outcome_.end == jobs::JobEnd::done && outcome_.executed_blocks != job_.block_count()) {
            wrong("done, and not every block was executed");
        }
    }

    /// Whatever the stream's thread does now, it sends nothing more once it has sent where the axes rest.
    void check_quiet() {
        driver_->close();
        const std::string after_close = wire_->written();
        std::this_thread::yield();
        if (wire_->written() != after_close) {
            wrong("something was sent after the end");
        }
    }

    void check_machine() {
        if (kind_ != StreamFault::none) {
            return;
        }
        const emulators::StreamEmulator& machine = wire_->settled();
        if (machine.truth().bad_lines > 0) {
            wrong("a line was no sample: " + machine.truth().first_fault);
        }
        if (machine.position().empty()) { // it was stopped before it was sent anywhere
            return;
        }
        for (int n = 0; n < router_.axis_count(); ++n) {
            const auto axis = static_cast<std::size_t>(n);
            const double rounding = 2e-6 / stream_period;
            if (machine.truth().greatest_speed[axis] > router_.axis(n).max_velocity + rounding) {
                wrong(fmt::format("axis {} went at {} mm/s", axis, machine.truth().greatest_speed[axis]));
            }
            const bool stood = outcome_.end != jobs::JobEnd::fault; // in an emergency stop it stays behind
            if (stood && std::abs(machine.position()[axis] - outcome_.position[n]) > 1e-5) {
                wrong(fmt::format("axis {} stands at {}, said to be at {}",
                                  axis,
                                  machine.position()[axis],
                                  outcome_.position[n]));
            }
        }
    }
};

TEST(StreamFaultCampaign, NeverMovesAfterTheEndNorLeavesTheLimitsInAThousandRuns) {
    constexpr int runs = 1000;
    const auto router = test::machine("router-xyz");
    const test::ScratchFolder logs;
    std::array<int, stream_fault_count> done{};
    std::array<int, stream_fault_count> all{};
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        StreamCampaignRun run(seed, router, logs.path());
        EXPECT_EQ(run.run(), "") << "seed " << seed;
        done[seed % stream_fault_count] += run.done() ? 1 : 0;
        ++all[seed % stream_fault_count];
    }
    for (std::size_t kind = 0; kind < stream_fault_count; ++kind) {
        fmt::print("kind {}: {:3} of {:3} ended well\n", kind, done[kind], all[kind]);
    }
    EXPECT_GT(done[static_cast<std::size_t>(StreamFault::none)], 0);
    EXPECT_LT(done[static_cast<std::size_t>(StreamFault::disconnect)],
              all[static_cast<std::size_t>(StreamFault::disconnect)]);
}

} // namespace
} // namespace millwright::drivers
