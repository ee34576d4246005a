#include "app/commands/run_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "app/planned_machine.h"
#include "app/posting.h"
#include "app/series.h"
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/machine/drivers/virtual_machine/virtual_machine.h"
#include "core/machine/run_from_line.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace millwright::app {

namespace {

struct Options {
    SeriesChoice series;
    PlannedChoice machine;       ///< and the driver of any
    ControllerChoice controller; ///< for grbl; its port and keys for all
    PostChoice post{.post = ""}; ///< empty: that of the driver
    std::optional<double> clearance;
};

std::string fault_of_speed(const std::string& text) {
    using machine::VirtualSpeed;
    double speed = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), speed);
    const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
    const bool inside = speed >= VirtualSpeed::slowest && speed <= VirtualSpeed::fastest;
    return whole && (inside || exactly_equal(speed, VirtualSpeed::unlimited))
               ? std::string()
               : fmt::format("'{}' is neither 0 nor between {} and {}",
                             text,
                             VirtualSpeed::slowest,
                             VirtualSpeed::fastest);
}

/// In the words of the driver's control, or of the one that was chosen.
machine::Job job_of(const OpenedProject& opened, const project::Plan& plan, const Options& options) {
    PostChoice choice = options.post;
    if (choice.post.empty()) {
        choice.post = options.machine.driver == "grbl" ? "grbl" : "linuxcnc";
    }
    machine::Job job;
    job.name = opened.file.stem().string();
    job.project = opened.file.string();
    job.started_at = now_for_people();
    job.machine = std::make_shared<const kinematics::MachineModel>(plan.workpiece->machine);
    PostedText text = posted(*plan.program, *job.machine, choice, job.name);
    print_notes(text);
    job.program = std::make_shared<const gcode::Program>(std::move(text.text.program));
    job.listing = std::make_shared<const gcode::Listing>(std::move(text.text.listing));
    return job;
}

machine::Job begun_at(machine::Job job, int line, const Options& options) {
    if (options.machine.driver == "cordic") {
        throw Error("the cordic driver runs programs from their beginning alone");
    }
    machine::RunFromSettings settings;
    settings.clearance = options.clearance;
    if (options.machine.driver == "grbl") { // which executes the text
        settings.dialect = gcode::Dialect::grbl;
        job.program = nullptr;
    }
    return machine::job_from_line(job, line, settings);
}

int run(const Options& options) {
    const Interrupt interrupt;
    std::optional<Controller> controller;
    if (options.machine.driver == "grbl") {
        if (options.controller.port.empty()) { // before the work is done
            throw Error("the grbl driver needs a port", {}, "give --port");
        }
        controller.emplace(options.controller);
    }
    PlannedChoice machine_choice = options.machine;
    machine_choice.port = options.controller.port;
    machine_choice.keys = options.controller.keys;
    PlannedMachine planned_machine(machine_choice);
    SeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        const OpenedProject opened = open_project(file);
        machine::Job job =
            job_of(opened, planned(opened, project::Scope::program, interrupt.token()), options);
        if (from_line > 1) {
            job = begun_at(job, from_line, options);
        }
        if (controller) {
            controller->check(job);
        }
        return job;
    };
    steps.ready = [&] {
        if (controller) {
            controller->connect();
        }
    };
    steps.run = [&](const machine::Job& job) {
        return controller ? controller->run(job, options.series.log, interrupt.token())
                          : planned_machine.run(job, options.series.log, interrupt.token());
    };
    return run_series(options.series, steps, interrupt.token());
}

} // namespace

void add_run_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("run", "Run the programs of projects on a machine");
    add_series_options(command, options->series, "Project files");
    add_clearance_option(command, options->clearance);
    command.add_option("--driver", options->machine.driver, "Machine to run on")
        ->required()
        ->check(CLI::IsMember({"virtual", "grbl", "stream", "cordic", "records"}));
    add_controller_options(command, options->controller);
    command.add_option("--period", options->machine.period, "Sampling period of a coordinate stream, s")
        ->type_name("S")
        ->capture_default_str();
    command
        .add_option("--clock", options->machine.processor_hz, "Clock frequency of the CORDIC processor, Hz")
        ->type_name("HZ")
        ->check(CLI::Range(1.0, 1e11))
        ->capture_default_str();
    add_record_options(command, options->machine.record);
    add_post_options(command, options->post);
    command
        .add_option("--speed",
                    options->machine.speed,
                    "Times real time, of the virtual machine and the CORDIC processor; 0: as fast as it goes")
        ->check(CLI::Validator(fault_of_speed, "0, or 0.01 to 1000"))
        ->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace millwright::app
