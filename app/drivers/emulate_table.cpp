#include "app/drivers/emulate_table.h"

#include "app/command_line/option_values.h"
#include "app/command_line/record_choice.h"
#include "app/drivers/emulation.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/emulators/table/table_emulator.h"
#include "core/kinematics/machine_file.h"
#include "core/links/fault_link.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace millwright::app {

namespace {

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

} // namespace

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

} // namespace millwright::app
