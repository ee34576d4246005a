// Streaming 1,000 short blocks per second to an emulated Grbl over a pseudo-terminal, in real time: how full
// its planner is meanwhile. 15 blocks are full; a planner that runs dry brakes.
#include "core/base/error.h"
#include "core/drivers/grbl/grbl_driver.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"
#include "core/jobs/job_log.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/serial_link.h"
#include "tests/support/scratch_folder.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace millwright {
namespace {

using drivers::DriverState;

constexpr int blocks = 5000;

std::string short_blocks() {
    std::string text = "G21G90G94\nG1F6000\n";
    for (int n = 1; n <= blocks; ++n) {
        text += fmt::format("X{:.1f}\n", 0.1 * n);
    }
    return text + "M30\n";
}

/// Waits for the end of a command or a program.
template <class Look> void watch(const drivers::Driver& driver, const Look& look) {
    while (driver.status().state == DriverState::running) {
        look();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    expects(driver.status().state == DriverState::idle, "the emulated controller ends well");
}

/// A driver and an emulated controller that can do 1,000 such blocks per second.
struct Wire {
    SteadyClock clock;
    std::unique_ptr<emulators::GrblServer> server;
    std::unique_ptr<drivers::GrblDriver> driver;

    Wire() {
        auto terminal = std::make_unique<links::PseudoTerminal>();
        terminal->open();
        auto near_end = std::make_unique<links::SerialLink>(terminal->path());
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(terminal));
        server = std::make_unique<emulators::GrblServer>(
            std::move(links), clock, emulators::GrblEmulatorOptions{.keep_truth = false});
        driver = std::make_unique<drivers::GrblDriver>(std::move(near_end), clock);
        driver->connect();
        for (const char* setting : {"$110=12000", "$120=9000", "$130=1000"}) {
            (void)driver->command(setting);
            watch(*driver, [] {});
        }
    }
    [[nodiscard]] int planned() const {
        return server->with_controller([](emulators::GrblEmulator& grbl) { return grbl.planned_blocks(); });
    }
};

void show(benchmark::State& state, std::vector<int> planned, double seconds) {
    std::ranges::sort(planned);
    const auto share = [&](double of) {
        return planned[static_cast<std::size_t>(of * static_cast<double>(planned.size() - 1))];
    };
    state.counters["blocks_per_s"] = blocks / seconds;
    state.counters["planned_least"] = planned.front();
    state.counters["planned_1_percent"] = share(0.01);
    state.counters["planned_median"] = share(0.5);
}

void stream(benchmark::State& state) {
    Wire wire;
    for (auto _ : state) {
        std::vector<int> planned;
        const double begin = wire.clock.now();
        wire.driver->start({nullptr, nullptr, jobs::text_job(short_blocks(), "short.ngc").listing, {}});
        watch(*wire.driver, [&] {
            const int sent = wire.driver->status().sent_blocks;
            if (sent > blocks / 10 && sent < blocks) {
                planned.push_back(wire.planned());
            }
        });
        show(state, std::move(planned), wire.clock.now() - begin);
    }
    wire.driver->close();
}

/// As a job: with a log that is written before anything is sent. `unknown`: the number of blocks whose state
/// would be unknown, had the program been killed; `log_lines`: per second.
void stream_a_job(benchmark::State& state) {
    Wire wire;
    const test::ScratchFolder folder;
    for (auto _ : state) {
        std::vector<int> planned;
        std::atomic<bool> over = false;
        std::jthread look([&] {
            for (; !over; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
                const int sent = wire.driver->status().sent_blocks;
                if (sent > blocks / 10 && sent < blocks) {
                    planned.push_back(wire.planned());
                }
            }
        });
        jobs::Dispatcher dispatcher(*wire.driver, wire.clock, folder.path());
        const jobs::JobOutcome outcome = dispatcher.run(jobs::text_job(short_blocks(), "short.ngc"), {});
        over = true;
        look.join();
        expects(outcome.end == jobs::JobEnd::done, "the job is done");
        const jobs::ReadLog log = jobs::read_job_log(outcome.log_file);
        int allowed = 0;
        std::vector<int> unknown;
        for (const jobs::LogRecord& record : log.records) {
            allowed = std::max(allowed, record.allowed_blocks);
            unknown.push_back(allowed - record.executed_blocks);
        }
        std::ranges::sort(unknown);
        state.counters["unknown_median"] = unknown[unknown.size() / 2];
        state.counters["unknown_most"] = unknown.back();
        state.counters["log_lines"] = static_cast<double>(log.records.size()) / outcome.elapsed;
        show(state, std::move(planned), outcome.elapsed);
    }
    wire.driver->close();
}

BENCHMARK(stream)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1)->Repetitions(3);
BENCHMARK(stream_a_job)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1)->Repetitions(3);

} // namespace
} // namespace millwright
