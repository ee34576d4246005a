#include "app/commands/send_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "app/planned_machine.h"
#include "app/series.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/kinematics/machine_file.h"
#include "core/machine/file_job.h"
#include "core/machine/run_from_line.h"
#include "core/project/assets.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct Options {
    SeriesChoice series;
    ControllerChoice controller;
    std::optional<double> clearance;
    std::string machine = "forming-table"; ///< of tables
    std::vector<double> at;                ///< where the table stands: X, Y, Z; empty: at the program's start
    PlannedChoice table;
};

bool is_table(const Options& options) {
    return options.controller.driver == "stream" || options.controller.driver == "records";
}

machine::Job job_of(const Options& options, const std::string& file, int from_line) {
    machine::Job job = machine::text_job(read_file(file), file);
    if (from_line > 1) {
        machine::RunFromSettings settings;
        settings.dialect =
            options.controller.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
        settings.clearance = options.clearance;
        job = machine::job_from_line(job, from_line, settings);
    }
    job.started_at = now_for_people();
    return job;
}

std::optional<kinematics::AxisPositions> place_of(const kinematics::MachineModel& model,
                                                  const std::vector<double>& at) {
    if (at.empty()) {
        return std::nullopt;
    }
    kinematics::AxisPositions place = kinematics::AxisPositions::Zero(model.axis_count());
    for (std::size_t n = 0; n < at.size(); ++n) {
        const int axis = model.axis_index("XYZ"[n]);
        if (axis < 0) {
            throw Error(fmt::format("machine '{}' has no axis {}", model.name(), "XYZ"[n]));
        }
        place[axis] = at[n];
    }
    return place;
}

/// Where something is to be done by hand: these machines have no words for it.
void say_what_is_by_hand(const machine::Job& job) {
    for (std::size_t n = 0; n < job.program->blocks.size(); ++n) {
        const gcode::Block& block = job.program->blocks[n];
        if (block.kind == gcode::BlockKind::spindle_on) {
            fmt::print(stderr,
                       "millwright: {}:{}: the spindle shall turn at {:.0f} 1/min: switch it on by hand\n",
                       job.project,
                       job.listing->line_of_block[n],
                       block.spindle_rpm);
            return;
        }
    }
}

machine::Job table_job(const Options& options, const std::string& file, int from_line) {
    const auto model = std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder())));
    machine::Job job = machine::file_job(file, model, {.start = place_of(*model, options.at)});
    if (from_line > 1) {
        machine::RunFromSettings settings;
        settings.clearance = options.clearance;
        job = machine::job_from_line(job, from_line, settings);
    }
    job.started_at = now_for_people();
    if (const auto faults = machine::preflight(job); !faults.empty()) {
        throw Error(faults.front());
    }
    say_what_is_by_hand(job);
    return job;
}

int send_to_table(const Options& options) {
    PlannedChoice choice = options.table;
    choice.driver = options.controller.driver;
    choice.port = options.controller.port;
    choice.keys = options.controller.keys;
    const Interrupt interrupt;
    PlannedMachine table(choice);
    SeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) { return table_job(options, file, from_line); };
    steps.ready = [] {};
    steps.run = [&](const machine::Job& job) {
        return table.run(job, options.series.log, interrupt.token());
    };
    return run_series(options.series, steps, interrupt.token());
}

int send(const Options& options) {
    const Interrupt interrupt;
    Controller controller(options.controller);
    SeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        machine::Job job = job_of(options, file, from_line);
        controller.check(job);
        return job;
    };
    steps.ready = [&] { controller.connect(); };
    steps.run = [&](const machine::Job& job) {
        return controller.run(job, options.series.log, interrupt.token());
    };
    return run_series(options.series, steps, interrupt.token());
}

} // namespace

void add_send_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("send", "Send files to a machine");
    add_series_options(command, options->series, "G-code files; of tables also path files");
    command.add_option("--driver", options->controller.driver, "Kind of controller, or of table")
        ->required()
        ->check(CLI::IsMember({"grbl", "linuxcnc", "stream", "records"}));
    add_controller_options(command, options->controller).required();
    command.add_option("--axes", options->controller.axes, "Axes of the machine, for linuxcnc")
        ->type_name("LETTERS")
        ->capture_default_str();
    add_clearance_option(command, options->clearance);
    command.add_option("--machine", options->machine, "Of tables: shipped machine or machine file")
        ->capture_default_str();
    command.add_option("--at", options->at, "Where the table stands: X,Y,Z, mm")->delimiter(',')->expected(3);
    command.add_option("--period", options->table.period, "Sampling period of a coordinate stream, s")
        ->type_name("S")
        ->capture_default_str();
    add_record_options(command, options->table.record);
    command.callback([&chosen, options] {
        chosen = [options] { return is_table(*options) ? send_to_table(*options) : send(*options); };
    });
}

} // namespace millwright::app
