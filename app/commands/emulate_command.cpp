#include "app/commands/emulate_command.h"

#include "app/commands/emulate_table.h"
#include "app/interrupt.h"
#include "core/base/error.h"
#include "core/kinematics/machine_file.h"
#include "core/machine/clock.h"
#include "core/machine/emulators/emulator_server.h"
#include "core/machine/emulators/grbl/grbl_emulator.h"
#include "core/machine/emulators/linuxcnc/linuxcnc_emulator.h"
#include "core/machine/emulators/pmac/pmac_emulator.h"
#include "core/machine/emulators/stream/stream_emulator.h"
#include "core/machine/links/fault_link.h"
#include "core/machine/links/pseudo_terminal.h"
#include "core/machine/links/tcp_server.h"
#include "core/project/assets.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

namespace {

struct Options {
    std::string pty;
    int tcp = -1;
    std::string bind = "127.0.0.1";
    std::string faults;
    std::string eeprom;
    std::string machine = "router-xyz";
    double speed = 1.0;
    bool line_numbers = false;
    bool echo = false;
    bool homed = false;
    bool arm = false;
    int channels = 4;
};

using Links = std::vector<std::unique_ptr<machine::Link>>;

Links open_links(const Options& options,
                 const std::string& name,
                 const machine::FaultSpec& faults,
                 const machine::Clock& clock) {
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
        fmt::print("{} at {}\n", name, links.back()->name());
    }
    std::fflush(stdout);
    return links;
}

/// Serves until somebody ends it, then tells by `last_words` how it was.
int serve(const Options& options,
          const std::string& name,
          const std::function<std::unique_ptr<machine::Emulator>()>& make,
          const std::function<void(const machine::Emulator&)>& last_words = {}) {
    const Interrupt interrupt; // before the emulator, which may have a thread
    const machine::FaultSpec faults = machine::read_fault_spec(options.faults);
    machine::SteadyClock clock;
    machine::EmulatorServer server(
        open_links(options, name, faults, clock), clock, make(), options.speed, faults);
    while (!interrupt.token().stop_requested()) {
        constexpr double glance = 0.05;
        clock.wait(glance);
        if (const std::string failure = server.failure(); !failure.empty()) {
            throw Error("the emulated controller failed: " + failure);
        }
    }
    if (last_words) {
        server.with_emulator([&](const machine::Emulator& served) { last_words(served); });
    }
    return 0;
}

int emulate_grbl(const Options& options) {
    return serve(options, "Grbl 1.1h", [&] {
        return std::make_unique<machine::GrblEmulator>(
            machine::GrblEmulatorOptions{.eeprom_file = options.eeprom,
                                         .line_numbers = options.line_numbers,
                                         .echo = options.echo,
                                         .keep_truth = false});
    });
}

int emulate_linuxcnc(const Options& options) {
    machine::LinuxCncEmulatorOptions wanted;
    wanted.model = std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder())));
    for (const kinematics::MachineAxis& axis : wanted.model->axes()) {
        if (std::string_view("XYZABC").find(axis.letter) == std::string_view::npos) {
            throw Error(fmt::format("linuxcncrsh knows no axis {}", axis.letter), options.machine);
        }
    }
    wanted.homed = options.homed;
    return serve(options, "LinuxCNC", [&] { return std::make_unique<machine::LinuxCncEmulator>(wanted); });
}

void tell_samples(const machine::StreamEmulator& stream) {
    const machine::StreamTruth& truth = stream.truth();
    fmt::print("{} samples\n", truth.samples);
    for (std::size_t n = 0; n < stream.position().size(); ++n) {
        fmt::print("{} {:.4f}, at most {:.2f} a second\n",
                   stream.axes()[n],
                   stream.position()[n],
                   truth.greatest_speed[n]);
    }
    if (truth.bad_lines > 0) {
        fmt::print("{} lines were no samples; the first: {}\n", truth.bad_lines, truth.first_fault);
    }
}

int emulate_stream(const Options& options) {
    return serve(
        options,
        "A coordinate stream",
        [] { return std::make_unique<machine::StreamEmulator>(); },
        [](const machine::Emulator& served) {
            tell_samples(static_cast<const machine::StreamEmulator&>(served));
        });
}

int emulate_pmac(const Options& options) {
    const machine::PmacEmulatorOptions wanted{.plants = options.arm ? machine::arm_plants()
                                                                    : std::vector<machine::PmacPlant>{},
                                              .channels = options.channels};
    return serve(options, "PMAC-Lite", [&] { return std::make_unique<machine::PmacEmulator>(wanted); });
}

CLI::App& add_emulated(CLI::App& group,
                       const std::string& name,
                       const std::string& what,
                       const std::shared_ptr<Options>& options) {
    CLI::App& command = *group.add_subcommand(name, what);
    command.add_option("--pty", options->pty, "Symbolic link to make to a pseudo-terminal")
        ->type_name("LINK");
    constexpr int greatest_port = 65535;
    command.add_option("--tcp", options->tcp, "TCP port to listen on; 0: any free one")
        ->check(CLI::Range(0, greatest_port))
        ->type_name("PORT");
    command.add_option("--bind", options->bind, "Address to listen on")
        ->type_name("ADDRESS")
        ->capture_default_str();
    command.add_option("--faults", options->faults, "Faults of wire and controller, as drop=0.001,seed=7")
        ->type_name("SPEC");
    constexpr double slowest = 0.01;
    constexpr double fastest = 1000.0;
    command.add_option("--speed", options->speed, "Machine seconds a second")
        ->check(CLI::Range(slowest, fastest))
        ->capture_default_str();
    return command;
}

} // namespace

void add_emulate_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& group = *app.add_subcommand("emulate", "Be a controller, to try things out without a machine");
    group.require_subcommand(1);
    CLI::App& grbl = add_emulated(group, "grbl", "Grbl 1.1 on a pseudo-terminal or a TCP port", options);
    grbl.add_option("--eeprom", options->eeprom, "File that keeps settings and offsets")->type_name("FILE");
    grbl.add_flag("--line-numbers", options->line_numbers, "Report the number of the line in motion");
    grbl.add_flag("--echo", options->echo, "Repeat each line as it was read");
    grbl.callback([&chosen, options] { chosen = [options] { return emulate_grbl(*options); }; });
    CLI::App& linuxcnc = add_emulated(group, "linuxcnc", "LinuxCNC behind its linuxcncrsh", options);
    linuxcnc.add_option("--machine", options->machine, "Shipped machine or machine file")
        ->capture_default_str();
    linuxcnc.add_flag("--homed", options->homed, "Begin switched on and homed");
    linuxcnc.callback([&chosen, options] { chosen = [options] { return emulate_linuxcnc(*options); }; });
    CLI::App& stream = add_emulated(group, "stream", "A machine that takes a coordinate stream", options);
    stream.callback([&chosen, options] { chosen = [options] { return emulate_stream(*options); }; });
    CLI::App& pmac = add_emulated(group, "pmac", "A Delta Tau PMAC-Lite with its motors", options);
    pmac.add_flag("--arm", options->arm, "The drives of the Motoman L-3 instead of ones without offsets");
    pmac.add_option("--channels", options->channels, "4, or 8 with a second row of outputs")
        ->check(CLI::IsMember({4, 8}))
        ->capture_default_str();
    pmac.callback([&chosen, options] { chosen = [options] { return emulate_pmac(*options); }; });
    add_emulate_table(group, chosen);
}

} // namespace millwright::app
