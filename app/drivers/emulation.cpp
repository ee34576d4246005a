#include "app/drivers/emulation.h"

#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/emulators/emulator.h"
#include "core/links/fault_link.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/tcp.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using Links = std::vector<std::unique_ptr<links::Link>>;

Links open_links(const EmulationChoice& choice,
                 const std::string& name,
                 const links::FaultSpec& faults,
                 const Clock& clock) {
    Links inner;
    if (!choice.pty.empty()) {
        inner.push_back(std::make_unique<links::PseudoTerminal>(choice.pty));
    }
    if (choice.tcp >= 0) {
        inner.push_back(
            std::make_unique<links::TcpServer>(static_cast<std::uint16_t>(choice.tcp), choice.bind));
    }
    if (inner.empty()) {
        throw UsageError("the emulated controller has no connection", {}, "give --pty LINK or --tcp PORT");
    }
    Links links;
    for (auto& link : inner) {
        links.push_back(
            std::make_unique<links::FaultLink>(std::move(link), faults, links::WireEnd::controller, clock));
        links.back()->open();
        fmt::print("{} at {}\n", name, links.back()->name());
    }
    std::fflush(stdout);
    return links;
}

links::FaultSpec faults_of(const EmulationChoice& choice) {
    try {
        return links::read_fault_spec(choice.faults);
    } catch (const Error& error) {
        throw UsageError(error.diagnostic());
    }
}

/// What a host sent before the end is executed, too: its bytes may still be under way.
void hear_the_rest(const emulators::EmulatorServer& server, SteadyClock& clock) {
    constexpr double glance = 0.05, quiet = 0.25, longest = 2.0; // s
    double silence = 0.0;
    std::int64_t heard = server.heard();
    for (double waited = 0.0; waited < longest && silence < quiet; waited += glance) {
        clock.wait(glance);
        const std::int64_t before = std::exchange(heard, server.heard());
        silence = heard == before ? silence + glance : 0.0;
    }
}

} // namespace

void add_emulation_options(CLI::App& command, EmulationChoice& choice) {
    command.add_option("--pty", choice.pty, "Symbolic link to create to a pseudo-terminal")
        ->type_name("LINK");
    constexpr int greatest_port = 65535;
    command.add_option("--tcp", choice.tcp, "TCP port to listen on (0: any free port)")
        ->check(CLI::Range(0, greatest_port))
        ->type_name("PORT");
    command.add_option("--bind", choice.bind, "Address to listen on")
        ->type_name("ADDRESS")
        ->capture_default_str();
    command
        .add_option("--faults",
                    choice.faults,
                    "Faults of the link and the controller, such as drop=0.001,seed=7; N in disconnect=N, "
                    "stall=N, reset=N, alarm=N and estop=N counts bytes")
        ->type_name("SPEC");
    constexpr double slowest = 0.01;
    constexpr double fastest = 1000.0;
    command.add_option("--speed", choice.speed, "Machine seconds per real second")
        ->check(CLI::Range(slowest, fastest))
        ->capture_default_str();
    command
        .add_option("--wait-for-host",
                    choice.wait_for_host,
                    "Machine seconds without a byte from the host after which the emulated time pauses until "
                    "the next byte (for slow hosts)")
        ->check(CLI::Range(0.001, 3600.0))
        ->type_name("SECONDS");
}

int serve(const EmulationChoice& choice,
          const std::string& name,
          const std::function<std::unique_ptr<emulators::Emulator>()>& make,
          const std::function<void(const emulators::Emulator&)>& last_words) {
    const Interrupt interrupt; // before the emulator, which may have a thread
    const links::FaultSpec faults = faults_of(choice);
    SteadyClock clock;
    emulators::EmulatorServer server(
        open_links(choice, name, faults, clock), clock, make(), choice.speed, faults);
    server.wait_for_host(choice.wait_for_host);
    server.reset_when_opened(choice.reset_when_opened);
    while (!interrupt.token().stop_requested()) {
        constexpr double glance = 0.05;
        clock.wait(glance);
        if (const std::string failure = server.failure(); !failure.empty()) {
            throw Error("the emulated controller failed: " + failure);
        }
    }
    if (last_words) {
        hear_the_rest(server, clock);
        server.with_emulator([&](const emulators::Emulator& served) { last_words(served); });
    }
    return 0;
}

} // namespace millwright::app
