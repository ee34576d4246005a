// Streaming 1,000 short blocks a second to an emulated Grbl over a pseudo-terminal, in real time: how full
// its planner is meanwhile. 15 blocks are full; a planner that runs dry brakes.
#include "core/base/error.h"
#include "core/machine/drivers/grbl/grbl_driver.h"
#include "core/machine/emulators/grbl/grbl_server.h"
#include "core/machine/job.h"
#include "core/machine/links/pseudo_terminal.h"
#include "core/machine/links/serial_link.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace millwright {
namespace {

using machine::DriverState;

constexpr int blocks = 5000;

std::string short_blocks() {
    std::string text = "G21G90G94\nG1F6000\n";
    for (int n = 1; n <= blocks; ++n) {
        text += fmt::format("X{:.1f}\n", 0.1 * n);
    }
    return text + "M30\n";
}

/// Waits for the end of a command or a program.
template <class Look> void watch(const machine::Driver& driver, const Look& look) {
    while (driver.status().state == DriverState::running) {
        look();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    expects(driver.status().state == DriverState::idle, "the emulated controller ends well");
}

void stream(benchmark::State& state) {
    machine::SteadyClock clock;
    auto terminal = std::make_unique<machine::PseudoTerminal>();
    terminal->open();
    auto near_end = std::make_unique<machine::SerialLink>(terminal->path());
    std::vector<std::unique_ptr<machine::Link>> links;
    links.push_back(std::move(terminal));
    machine::GrblServer server(std::move(links), clock, {.keep_truth = false});
    machine::GrblDriver driver(std::move(near_end), clock);
    driver.connect();
    for (const char* setting : {"$110=12000", "$120=9000"}) {
        (void)driver.command(setting);
        watch(driver, [] {});
    }
    for (auto _ : state) {
        std::vector<int> planned;
        const double begin = clock.now();
        driver.start({nullptr, nullptr, machine::text_job(short_blocks(), "short.ngc").listing, {}});
        watch(driver, [&] {
            const int sent = driver.status().sent_blocks;
            if (sent > blocks / 10 && sent < blocks) {
                planned.push_back(server.with_controller(
                    [](machine::GrblEmulator& grbl) { return grbl.planned_blocks(); }));
            }
        });
        const double seconds = clock.now() - begin;
        std::ranges::sort(planned);
        const auto share = [&](double of) {
            return planned[static_cast<std::size_t>(of * static_cast<double>(planned.size() - 1))];
        };
        state.counters["blocks_a_s"] = blocks / seconds;
        state.counters["planned_least"] = planned.front();
        state.counters["planned_1_percent"] = share(0.01);
        state.counters["planned_median"] = share(0.5);
    }
    driver.close();
}

BENCHMARK(stream)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1)->Repetitions(3);

} // namespace
} // namespace millwright
