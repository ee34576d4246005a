#include "app/command_line/command.h"
#include "app/command_line/option_values.h"
#include "app/command_line/record_choice.h"
#include "app/drivers/driver_commands.h"
#include "app/drivers/emulation.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/emulators/linuxcnc/linuxcnc_emulator.h"
#include "core/emulators/stream/stream_emulator.h"
#include "core/emulators/table/table_emulator.h"
#include "core/kinematics/machine_file.h"
#include "core/links/fault_link.h"
#include "core/pmac/emulator/pmac_emulator.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::app {

namespace {

// `millwright emulate table`: the other end of a coordinate stream of records.

struct TableChoice {
    EmulationChoice wire;
    std::string machine = "forming-table";
    RecordChoice record = {.pattern = drivers::RecordFormat().pattern, .format = {}};
    emulators::TableOptions table;
};

void tell_records(const emulators::TableEmulator& table,
                  const kinematics::MachineModel& model,
                  const std::string& pattern) {
    fmt::print("{} executed, {}, at",
               counted(table.records(), "record"),
               counted(table.bad_lines(), "invalid line", "invalid lines"));
    for (int n = 0; n < model.axis_count(); ++n) {
        fmt::print(" {} {:.4f}", model.axis(n).letter, table.position()[static_cast<std::size_t>(n)]);
    }
    fmt::print("\n");
    if (table.bad_lines() > 0) {
        fmt::print("this table expects records as \"{}\"\n", pattern);
    }
}

int emulate_table(const TableChoice& choice) {
    const kinematics::MachineModel model = kinematics::read_machine(
        project::machine_path(choice.machine, std::filesystem::current_path(), project::assets_folder()));
    const drivers::RecordFormat format = record_of(choice.record).value();
    if (links::read_fault_spec(choice.wire.faults).lost_ok > 0.0 && format.answer != "ok") {
        throw UsageError(
            "the fault lost-ok drops an answer 'ok', which this table does not send", {}, "give --answer ok");
    }
    return serve(
        choice.wire,
        model.name(),
        [&] { return std::make_unique<emulators::TableEmulator>(format, model, choice.table); },
        [&](const emulators::Emulator& served) {
            tell_records(static_cast<const emulators::TableEmulator&>(served), model, format.pattern);
        });
}

void add_emulate_table(CLI::App& group, Command& chosen) {
    const auto choice = std::make_shared<TableChoice>();
    CLI::App& command = *group.add_subcommand("table", "A table that accepts records");
    add_emulation_options(command, choice->wire);
    command.add_option("--machine", choice->machine, "Shipped machine or machine file, for its axes")
        ->capture_default_str();
    add_record_options(command, choice->record);
    command.add_option(
        "--silent-from", choice->table.silent_from, "Stop answering from this record on (0: never)");
    command.add_flag(
        "--takes-time", choice->table.takes_time, "Move at the speed given by {s}, and answer on arrival");
    command.add_option("--refuse", choice->table.refuses, "Answer this record with 'error' (0: none)");
    command.add_option("--double", choice->table.doubles, "Answer this record twice (0: none)");
    command.callback([&chosen, choice] { chosen = [choice] { return emulate_table(*choice); }; });
}

struct EmulatedGrbl {
    EmulationChoice wire;
    std::string firmware = "grbl";
    std::string axes = "XYZ";
    std::string eeprom;
    std::optional<double> surface; ///< height of what a probe touches, mm
    bool line_numbers = false;
    bool echo = false;
    bool mist = false;
    bool no_switches = false;
};

struct EmulatedLinuxCnc {
    EmulationChoice wire;
    std::string machine = "router-xyz";
    bool homed = false;
};

struct EmulatedPmac {
    EmulationChoice wire;
    bool arm = false;
    int channels = 4;
};

struct FirmwareName {
    std::string_view name, version;
    emulators::EmulatedFirmware firmware;
};
constexpr std::array firmware_names = {
    FirmwareName{"grbl", "Grbl 1.1h", emulators::EmulatedFirmware::grbl},
    FirmwareName{"grblhal", "grblHAL 1.1f", emulators::EmulatedFirmware::grblhal},
    FirmwareName{"fluidnc", "FluidNC v3.7.12", emulators::EmulatedFirmware::fluidnc}};

int emulate_grbl(const EmulatedGrbl& options) {
    const auto* const firmware = std::ranges::find(firmware_names, options.firmware, &FirmwareName::name);
    std::function<double(double, double)> surface;
    if (options.surface) {
        surface = [z = *options.surface](double, double) { return z; };
    }
    if (options.wire.reset_when_opened && options.wire.tcp < 0) {
        throw UsageError(
            "a pseudo-terminal does not report when it is opened", {}, "use --reset-when-opened with --tcp");
    }
    return serve(options.wire, std::string(firmware->version), [&] {
        auto grbl = std::make_unique<emulators::GrblEmulator>(
            emulators::GrblEmulatorOptions{.firmware = firmware->firmware,
                                           .axes = options.axes,
                                           .eeprom_file = options.eeprom,
                                           .line_numbers = options.line_numbers,
                                           .echo = options.echo,
                                           .mist = options.mist,
                                           .keep_truth = false,
                                           .surface = surface});
        if (options.no_switches) {
            grbl->break_limit_switches();
        }
        return grbl;
    });
}

int emulate_linuxcnc(const EmulatedLinuxCnc& options) {
    emulators::LinuxCncEmulatorOptions wanted;
    wanted.model = std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder())));
    for (const kinematics::MachineAxis& axis : wanted.model->axes()) {
        if (std::string_view("XYZABC").find(axis.letter) == std::string_view::npos) {
            throw Error(fmt::format("linuxcncrsh does not support axis {}", axis.letter), options.machine);
        }
    }
    wanted.homed = options.homed;
    return serve(
        options.wire, "LinuxCNC", [&] { return std::make_unique<emulators::LinuxCncEmulator>(wanted); });
}

void tell_samples(const emulators::StreamEmulator& stream) {
    const emulators::StreamTruth& truth = stream.truth();
    fmt::print("{}\n", counted(truth.samples, "sample"));
    for (std::size_t n = 0; n < stream.position().size(); ++n) {
        fmt::print("{} {:.4f}, at most {:.2f} per second\n",
                   stream.axes()[n],
                   stream.position()[n],
                   truth.greatest_speed[n]);
    }
    if (truth.bad_lines > 0) {
        fmt::print("{}; the first: {}\n",
                   counted(truth.bad_lines, "line was not a sample", "lines were not samples"),
                   truth.first_fault);
    }
}

int emulate_stream(const EmulationChoice& wire) {
    return serve(
        wire,
        "A coordinate stream",
        [] { return std::make_unique<emulators::StreamEmulator>(); },
        [](const emulators::Emulator& served) {
            tell_samples(static_cast<const emulators::StreamEmulator&>(served));
        });
}

int emulate_pmac(const EmulatedPmac& options) {
    const pmac::PmacEmulatorOptions wanted{.plants = options.arm ? pmac::arm_plants()
                                                                 : std::vector<pmac::PmacPlant>{},
                                           .channels = options.channels};
    return serve(options.wire, "PMAC-Lite", [&] { return std::make_unique<pmac::PmacEmulator>(wanted); });
}

CLI::App&
add_emulated(CLI::App& group, const std::string& name, const std::string& what, EmulationChoice& wire) {
    CLI::App& command = *group.add_subcommand(name, what);
    add_emulation_options(command, wire);
    return command;
}

void add_grbl(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<EmulatedGrbl>();
    CLI::App& command = add_emulated(
        group, "grbl", "Grbl 1.1, grblHAL or FluidNC on a pseudo-terminal or a TCP port", options->wire);
    command.add_option("--firmware", options->firmware, "Firmware to emulate")
        ->check(CLI::IsMember({"grbl", "grblhal", "fluidnc"}))
        ->capture_default_str();
    command.add_option("--axes", options->axes, "Axes: XYZ, followed by up to three of A B C U V W")
        ->type_name("LETTERS")
        ->capture_default_str();
    command.add_option("--eeprom", options->eeprom, "File that stores settings and offsets")
        ->type_name("FILE");
    command.add_flag("--line-numbers", options->line_numbers, "Report the line number of the current motion");
    command.add_flag("--echo", options->echo, "Echo each line as it was read");
    command.add_flag("--mist", options->mist, "Support M7 (mist coolant)");
    command.add_flag("--no-switches", options->no_switches, "Never trigger the limit switches");
    command.add_flag("--reset-when-opened",
                     options->wire.reset_when_opened,
                     "Reset whenever a program connects, like boards wired to DTR (with --tcp)");
    command
        .add_option("--surface", options->surface, "Height at which a probe touches, machine coordinates, mm")
        ->type_name("Z");
    command.callback([&chosen, options] { chosen = [options] { return emulate_grbl(*options); }; });
}

void add_linuxcnc(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<EmulatedLinuxCnc>();
    CLI::App& command =
        add_emulated(group, "linuxcnc", "LinuxCNC, accessed through its linuxcncrsh", options->wire);
    command.add_option("--machine", options->machine, "Shipped machine or machine file")
        ->capture_default_str();
    command.add_flag("--homed", options->homed, "Start switched on and homed");
    command.callback([&chosen, options] { chosen = [options] { return emulate_linuxcnc(*options); }; });
}

void add_stream(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<EmulationChoice>();
    CLI::App& command = add_emulated(group, "stream", "A machine that accepts a coordinate stream", *options);
    command.callback([&chosen, options] { chosen = [options] { return emulate_stream(*options); }; });
}

void add_pmac(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<EmulatedPmac>();
    CLI::App& command = add_emulated(group, "pmac", "A Delta Tau PMAC-Lite with its motors", options->wire);
    command.add_flag(
        "--arm", options->arm, "Emulate the drives of the Motoman L-3 instead of drives without offsets");
    command
        .add_option(
            "--channels", options->channels, "Number of channels: 4, or 8 with a second row of outputs")
        ->check(CLI::IsMember({4, 8}))
        ->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return emulate_pmac(*options); }; });
}

} // namespace

void add_emulate_command(CLI::App& app, Command& chosen) {
    CLI::App& group =
        *app.add_subcommand("emulate", "Emulate a controller, to try things out without a machine");
    group.require_subcommand(1);
    add_grbl(group, chosen);
    add_linuxcnc(group, chosen);
    add_stream(group, chosen);
    add_pmac(group, chosen);
    add_emulate_table(group, chosen);
}

} // namespace millwright::app
