#include "app/commands/emulate_command.h"

#include "app/interrupt.h"
#include "core/base/error.h"
#include "core/machine/clock.h"
#include "core/machine/emulators/grbl/grbl_server.h"
#include "core/machine/links/fault_link.h"
#include "core/machine/links/pseudo_terminal.h"
#include "core/machine/links/tcp_server.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct Options {
    std::string pty;
    int tcp = -1;
    std::string bind = "127.0.0.1";
    std::string faults;
    std::string eeprom;
    double speed = 1.0;
    bool line_numbers = false;
    bool echo = false;
};

using Links = std::vector<std::unique_ptr<machine::Link>>;

Links open_links(const Options& options, const machine::FaultSpec& faults, const machine::Clock& clock) {
    Links inner;
    if (!options.pty.empty()) {
        inner.push_back(std::make_unique<machine::PseudoTerminal>(options.pty));
    }
    if (options.tcp >= 0) {
        inner.push_back(
            std::make_unique<machine::TcpServer>(static_cast<std::uint16_t>(options.tcp), options.bind));
    }
    if (inner.empty()) {
        throw Error("nobody could reach the emulated controller", {}, "name --pty LINK or --tcp PORT");
    }
    Links links;
    for (auto& link : inner) {
        links.push_back(std::make_unique<machine::FaultLink>(
            std::move(link), faults, machine::WireEnd::controller, clock));
        links.back()->open();
        fmt::print("Grbl 1.1h at {}\n", links.back()->name());
    }
    std::fflush(stdout);
    return links;
}

int emulate(const Options& options) {
    const Interrupt interrupt;
    const machine::FaultSpec faults = machine::read_fault_spec(options.faults);
    machine::SteadyClock clock;
    machine::GrblServer server(open_links(options, faults, clock),
                               clock,
                               {.eeprom_file = options.eeprom,
                                .line_numbers = options.line_numbers,
                                .echo = options.echo,
                                .keep_truth = false},
                               options.speed,
                               faults);
    while (!interrupt.token().stop_requested()) {
        constexpr double glance = 0.05;
        clock.wait(glance);
        if (const std::string failure = server.failure(); !failure.empty()) {
            throw Error("the emulated controller failed: " + failure);
        }
    }
    return 0;
}

} // namespace

void add_emulate_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *app.add_subcommand("emulate", "Be a controller, to try things out without a machine");
    command.require_subcommand(1);
    CLI::App& grbl = *command.add_subcommand("grbl", "Grbl 1.1 on a pseudo-terminal or a TCP port");
    grbl.add_option("--pty", options->pty, "Symbolic link to make to a pseudo-terminal")->type_name("LINK");
    constexpr int greatest_port = 65535;
    grbl.add_option("--tcp", options->tcp, "TCP port to listen on; 0: any free one")
        ->check(CLI::Range(0, greatest_port))
        ->type_name("PORT");
    grbl.add_option("--bind", options->bind, "Address to listen on")
        ->type_name("ADDRESS")
        ->capture_default_str();
    grbl.add_option("--faults", options->faults, "Faults of wire and controller, as drop=0.001,seed=7")
        ->type_name("SPEC");
    grbl.add_option("--eeprom", options->eeprom, "File that keeps settings and offsets")->type_name("FILE");
    constexpr double slowest = 0.01;
    constexpr double fastest = 1000.0;
    grbl.add_option("--speed", options->speed, "Machine seconds a second")
        ->check(CLI::Range(slowest, fastest))
        ->capture_default_str();
    grbl.add_flag("--line-numbers", options->line_numbers, "Report the number of the line in motion");
    grbl.add_flag("--echo", options->echo, "Repeat each line as it was read");
    grbl.callback([&chosen, options] { chosen = [options] { return emulate(*options); }; });
}

} // namespace millwright::app
