#include "app/command_line/arm_choice.h"
#include "app/command_line/command.h"
#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/command_line/watched_work.h"
#include "app/drivers/connected_controller.h"
#include "app/drivers/driver_commands.h"
#include "app/drivers/driver_options.h"
#include "app/drivers/job_series.h"
#include "app/drivers/planned_machine.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/gcode_programs/machine_program.h"
#include "core/jobs/file_job.h"
#include "core/jobs/program_check.h"
#include "core/jobs/run_from_line.h"
#include "core/kinematics/machine_file.h"
#include "core/machine/drivers_by_name.h"
#include "core/plot/path_file.h"
#include "core/pmac/emulator/motion_program.h"
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

struct SendOptions {
    JobSeriesChoice series;
    PlannedMachineChoice machine; ///< its controller also for grbl and linuxcnc
    std::string model;            ///< of a machine that is moved position by position
    std::vector<double> at;       ///< its position: X, Y, Z; empty: at the program's start
    std::vector<double> origin;   ///< where the files' zero lies on it: X, Y and perhaps Z
    std::optional<double> clearance;
};

machine::MachineKind kind_of(const SendOptions& options) {
    return machine::driver_row(options.machine.driver).kind;
}

bool is_simulated(const SendOptions& options) {
    return kind_of(options) == machine::MachineKind::simulated;
}

bool is_moved_from_here(const SendOptions& options) {
    return is_simulated(options) || kind_of(options) == machine::MachineKind::positioned;
}

void check_model(const SendOptions& options) {
    const bool moved = is_moved_from_here(options);
    if (moved && options.model.empty()) {
        throw UsageError("the " + options.machine.driver + " driver needs a machine", {}, "give --machine");
    }
    if (!moved && (!options.model.empty() || !options.at.empty())) {
        throw UsageError("--machine and --at apply only to the drivers virtual, cordic, stream and records");
    }
    if (!options.origin.empty() && !moved) {
        throw UsageError("--origin applies only to the drivers virtual, cordic, stream and records",
                         {},
                         "use the work offsets of the controller, such as G54");
    }
}

/// Records and coordinates go straight from where the machine stands, and it does not tell where that is.
void check_place(const SendOptions& options) {
    if (options.series.from_line > 1 && options.at.empty() &&
        kind_of(options) == machine::MachineKind::positioned) {
        throw Error("starting at a line requires the position of the machine, which it does not report",
                    {},
                    "read X, Y and Z at the machine and give them with --at X,Y,Z");
    }
}

std::shared_ptr<const kinematics::MachineModel> model_of(const SendOptions& options) {
    return std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
        project::machine_path(options.model, std::filesystem::current_path(), project::assets_folder())));
}

/// A machine that is simulated begins at zero, or at its nearest limits.
std::optional<kinematics::AxisPositions> place_of(const kinematics::MachineModel& model,
                                                  const SendOptions& options) {
    const std::vector<double>& at = options.at;
    if (at.empty()) {
        return is_simulated(options)
                   ? std::optional(gcode::MachineProgramBuilder(model, "").take().program.start)
                   : std::nullopt;
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
void say_what_is_by_hand(const jobs::Job& job) {
    for (std::size_t n = 0; n < job.program->blocks.size(); ++n) {
        const program::Block& block = job.program->blocks[n];
        if (block.kind == program::BlockKind::spindle_on) {
            fmt::print(stderr,
                       "millwright: {}:{}: the spindle must turn at {:.0f} 1/min: switch it on manually\n",
                       job.project,
                       job.listing->line_of_block[n],
                       block.spindle_rpm);
            return;
        }
    }
}

/// `job` from the line that was asked for, with the time.
jobs::Job ready(jobs::Job job, const SendOptions& options, int from_line) {
    if (from_line > 1 && kind_of(options) == machine::MachineKind::arm) {
        throw Error(
            "a motion program must start at its first line: what a line does depends on the lines above");
    }
    check_from_line(options.machine, from_line);
    if (options.machine.driver == "grbl") {
        job.tool_change = tool_change_plan(options.machine.controller.tool_change);
    }
    if (from_line > 1) {
        jobs::RunFromSettings settings;
        settings.dialect = options.machine.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
        settings.clearance = options.clearance;
        job = jobs::job_from_line(job, from_line, settings);
    }
    job.started_at = now_for_people();
    return job;
}

/// Of a PMAC in its own language, else G-code.
jobs::Job job_from_file(const SendOptions& options, const std::string& file) {
    return kind_of(options) == machine::MachineKind::arm ? pmac::motion_program_job(read_file(file), file)
                                                         : jobs::text_job(read_file(file), file);
}

/// To a controller that plans for itself.
int send_text(const SendOptions& options) {
    const Interrupt interrupt(Suspending::refused);
    ConnectedController controller(options.machine.controller, options.series.log);
    JobSeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        jobs::Job job = ready(job_from_file(options, file), options, from_line);
        controller.check(job);
        return job;
    };
    steps.ready = [&] { controller.connect(options.series.from_line > 1, interrupt.token()); };
    steps.look = [&](const jobs::Job& job) { controller.look_at(job); };
    steps.run = [&](const jobs::Job& job) { return controller.run(job, interrupt); };
    if (options.machine.controller.check_only) {
        steps.instead = [&](const jobs::Job& job) { controller.check_there(job, interrupt.token()); };
    }
    return run_job_series(options.series, steps, interrupt.token());
}

int send_motion(const SendOptions& options) {
    const Interrupt interrupt(Suspending::refused);
    const auto model = model_of(options);
    PlannedMachine machine(options.machine);
    JobSeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        if (options.machine.driver == "cordic" && plot::is_path_file(read_file(file))) {
            throw Error(
                Diagnostic{{file, 1, 1, -1}, "the CORDIC processor accepts G-code, not a path file", {}});
        }
        jobs::Job job =
            ready(jobs::file_job(
                      file, model, {.start = place_of(*model, options), .origin = options.machine.origin}),
                  options,
                  from_line);
        app::print_warnings(job.notices);
        if (const auto faults = jobs::preflight(job); !faults.empty()) {
            throw Error(faults.front());
        }
        if (const auto slowed = jobs::feeds_not_reached(job)) {
            fmt::print(stderr, "millwright: {}\n", to_text(*slowed));
        }
        if (kind_of(options) == machine::MachineKind::positioned) {
            say_what_is_by_hand(job);
        }
        return job;
    };
    steps.ready = [] {};
    steps.run = [&](const jobs::Job& job) { return machine.run(job, options.series.log, interrupt); };
    return run_job_series(options.series, steps, interrupt.token());
}

int send(SendOptions options) {
    if (!options.origin.empty()) {
        options.machine.origin = origin_from(options.origin);
    }
    check(options.machine);
    check_model(options);
    check_place(options);
    return is_moved_from_here(options) ? send_motion(options) : send_text(options);
}

} // namespace

void add_send_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<SendOptions>();
    CLI::App& command = *app.add_subcommand("send", "Send files to a machine");
    add_job_series_options(
        command, options->series, "G-code files; with --machine also path files; for a PMAC motion programs");
    command.add_option("--driver", options->machine.driver, "Controller type, or machine to run on")
        ->required()
        ->check(CLI::IsMember(machine::driver_names()));
    command
        .add_option("--machine",
                    options->model,
                    "Shipped machine or machine file, for virtual, cordic, stream and records")
        ->type_name("NAME");
    command.add_option("--at", options->at, "Current position of that machine: X,Y,Z, mm")
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z")
        ->allow_extra_args(false);
    add_origin_option(command, options->origin);
    add_controller_options(command, options->machine.controller);
    add_tool_change_options(command, options->machine.controller.tool_change);
    add_planned_machine_options(command, options->machine);
    command
        .add_option("--axes",
                    options->machine.controller.axes,
                    "Axes of the machine, for linuxcnc; XYZAB for a pmac with axis 5")
        ->type_name("LETTERS")
        ->capture_default_str();
    add_arm_option(command, options->machine.controller.arm);
    add_clearance_option(command, options->clearance);
    command.callback([&chosen, &command, options] {
        options->series.options = options_to_go_on(command);
        options->machine.controller.driver = options->machine.driver;
        chosen = [&command, options] {
            expect_options_of_driver(command, options->machine.driver);
            expect_one_way(options->machine.controller, options->series.from_line);
            return send(*options);
        };
    });
}

} // namespace millwright::app
