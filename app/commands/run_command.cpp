#include "app/commands/run_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "app/posting.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/make_driver.h"
#include "core/machine/drivers/virtual_machine/virtual_machine.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

namespace millwright::app {

namespace {

struct Options {
    std::string project;
    std::string driver = "virtual";
    double speed = 1.0;
    double period = 0.01;
    ControllerChoice controller; ///< for grbl; its port also for stream
    PostChoice post{.post = ""}; ///< empty: that of the driver
    std::string log = "jobs";
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
        choice.post = options.driver == "grbl" ? "grbl" : "linuxcnc";
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

machine::JobOutcome
run_on_planned_machine(const machine::Job& job, const Options& options, const std::stop_token& stop) {
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
    machine::SteadyClock clock;
    machine::DriverChoice choice;
    choice.kind = machine::driver_kind(options.driver);
    choice.address = options.controller.port;
    choice.period = options.period;
    const auto driver = machine::make_driver(choice, {job.machine, job.program->start, options.speed}, clock);
    driver->connect();
    machine::Dispatcher dispatcher(*driver, clock, options.log);
    machine::JobOutcome outcome = dispatcher.run(job, progress);
    driver->close();
    return outcome;
}

/// Before the work is done.
void refuse_missing_port(const Options& options) {
    const bool inside = options.driver == "virtual" || options.driver == "cordic";
    if (!inside && options.controller.port.empty()) {
        throw Error("the " + options.driver + " driver needs a port", {}, "give --port");
    }
}

int run(const Options& options) {
    refuse_missing_port(options);
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const project::Plan plan = planned(opened, project::Scope::program, interrupt.token());
    const machine::Job job = job_of(opened, plan, options);
    const machine::JobOutcome outcome =
        options.driver == "grbl" ? run_on_controller(job, options.controller, options.log, interrupt.token())
                                 : run_on_planned_machine(job, options, interrupt.token());
    fmt::print("{}\nLog: {}\n", outcome.sentence, outcome.log_file.string());
    if (outcome.end == machine::JobEnd::cancelled) {
        throw Cancelled();
    }
    return outcome.end == machine::JobEnd::done ? 0 : 1;
}

} // namespace

void add_run_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("run", "Run the program of a project on a machine");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--driver", options->driver, "Machine to run on")
        ->required()
        ->check(CLI::IsMember({"virtual", "grbl", "stream", "cordic"}));
    add_controller_options(command, options->controller);
    command.add_option("--period", options->period, "Sampling period of a coordinate stream, s")
        ->type_name("S")
        ->capture_default_str();
    add_post_options(command, options->post);
    command
        .add_option("--speed",
                    options->speed,
                    "Times real time, of the virtual machine and the CORDIC processor; 0: as fast as it goes")
        ->check(CLI::Validator(fault_of_speed, "0, or 0.01 to 1000"))
        ->capture_default_str();
    command.add_option("--log", options->log, "Folder of the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace millwright::app
