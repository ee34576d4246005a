#include "app/commands/emulate_table.h"

#include "app/interrupt.h"
#include "app/record_choice.h"
#include "core/kinematics/machine_file.h"
#include "core/machine/clock.h"
#include "core/machine/emulators/table/table_emulator.h"
#include "core/machine/links/pseudo_terminal.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct TableChoice {
    std::string pty;
    std::string machine = "forming-table";
    RecordChoice record = {.pattern = machine::RecordFormat().pattern, .format = {}};
    machine::TableOptions table;
};

int emulate_table(const TableChoice& choice) {
    const Interrupt interrupt;
    const kinematics::MachineModel model = kinematics::read_machine(
        project::machine_path(choice.machine, std::filesystem::current_path(), project::assets_folder()));
    const machine::RecordFormat format = record_of(choice.record).value();
    machine::SteadyClock clock;
    const machine::TableEmulator table(
        std::make_unique<machine::PseudoTerminal>(choice.pty), format, model, choice.table);
    fmt::print("{} at {}\n", model.name(), choice.pty);
    std::fflush(stdout);
    while (!interrupt.token().stop_requested()) {
        constexpr double glance = 0.05;
        clock.wait(glance);
    }
    fmt::print("{} records obeyed, {} lines that were none, at", table.records(), table.bad_lines());
    const std::vector<double> position = table.position();
    for (int n = 0; n < model.axis_count(); ++n) {
        fmt::print(" {} {:.4f}", model.axis(n).letter, position[static_cast<std::size_t>(n)]);
    }
    fmt::print("\n");
    return 0;
}

} // namespace

void add_emulate_table(CLI::App& group, Command& chosen) {
    const auto choice = std::make_shared<TableChoice>();
    CLI::App& command = *group.add_subcommand("table", "A table that takes records, on a pseudo-terminal");
    command.add_option("--pty", choice->pty, "Symbolic link to make to it")->required()->type_name("LINK");
    command.add_option("--machine", choice->machine, "Shipped machine or machine file: its axes")
        ->capture_default_str();
    add_record_options(command, choice->record);
    command.add_option(
        "--silent-from", choice->table.silent_from, "Answers nothing from this record on; 0: never");
    command.add_option("--refuse", choice->table.refuses, "Answers this record by 'error'; 0: none");
    command.callback([&chosen, choice] { chosen = [choice] { return emulate_table(*choice); }; });
}

} // namespace millwright::app
