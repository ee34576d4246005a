#include "app/commands/run_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "app/job_keys.h"
#include "app/posting.h"
#include "app/progress_printer.h"
#include "app/record_choice.h"
#include "app/series.h"
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/cordic/cordic_driver.h"
#include "core/machine/drivers/make_driver.h"
#include "core/machine/drivers/stream/stream_driver.h"
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
    std::string driver = "virtual";
    double speed = 1.0;
    double period = 0.01;
    double processor_hz = machine::CordicDriverOptions().clock_hz;
    RecordChoice record;         ///< of a coordinate stream
    ControllerChoice controller; ///< for grbl; its port also for stream
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

machine::Job begun_at(machine::Job job, int line, const Options& options) {
    if (options.driver == "cordic") {
        throw Error("the cordic driver runs programs from their beginning alone");
    }
    machine::RunFromSettings settings;
    settings.clearance = options.clearance;
    if (options.driver == "grbl") { // which executes the text
        settings.dialect = gcode::Dialect::grbl;
        job.program = nullptr;
    }
    return machine::job_from_line(job, line, settings);
}

/// The virtual machine, or a stream of coordinates: what follows a motion that is planned here.
class PlannedMachine {
public:
    explicit PlannedMachine(const Options& options) : options_(options) {}

    machine::JobOutcome run(const machine::Job& job, const std::stop_token& stop) {
        connect(job);
        ProgressPrinter printer;
        const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
        machine::Dispatcher dispatcher(*driver_, clock_, options_.series.log);
        const JobKeys keys(dispatcher, options_.controller.keys);
        machine::JobOutcome outcome = dispatcher.run(job, progress);
        if (const std::string late = cordic_ == nullptr ? "" : cordic_->remark(); !late.empty()) {
            fmt::print(stderr, "millwright: {}: {}\n", job.name, late);
        }
        return outcome;
    }

private:
    const Options& options_;
    machine::SteadyClock clock_;
    std::string model_; ///< name of the machine that the driver moves
    std::unique_ptr<machine::Driver> driver_;
    const machine::CordicDriver* cordic_ = nullptr; ///< the same, if it is one

    /// The first job says which machine it is.
    void connect(const machine::Job& job) {
        if (driver_ == nullptr) {
            model_ = job.machine->name();
            driver_ = make_driver(job);
            driver_->connect();
        } else if (job.machine->name() != model_) {
            throw Error(fmt::format("{} is for machine '{}', and '{}' is connected",
                                    job.project,
                                    job.machine->name(),
                                    model_),
                        {},
                        "run it by itself");
        }
    }

    std::unique_ptr<machine::Driver> make_driver(const machine::Job& job) {
        machine::DriverChoice choice;
        choice.kind = machine::driver_kind(options_.driver);
        choice.address = options_.controller.port;
        choice.period = options_.period;
        if (choice.kind == machine::DriverKind::cordic) {
            machine::CordicDriverOptions processor;
            processor.clock_hz = options_.processor_hz;
            auto made = std::make_unique<machine::CordicDriver>(
                job.program->start, machine::VirtualSpeed{options_.speed}, clock_, job.machine, processor);
            cordic_ = made.get();
            return made;
        }
        if (const auto record = record_of(options_.record)) {
            return std::make_unique<machine::StreamDriver>(
                machine::make_link(choice.address),
                clock_,
                job.machine,
                job.program->start,
                machine::StreamOptions{.period = options_.period, .record = record});
        }
        return machine::make_driver(choice, {job.machine, job.program->start, options_.speed}, clock_);
    }
};

/// Before the work is done.
void refuse_missing_port(const Options& options) {
    if (!options.record.pattern.empty() && options.driver != "stream") {
        throw Error("records are for the stream driver");
    }
    const bool inside = options.driver == "virtual" || options.driver == "cordic";
    if (!inside && options.controller.port.empty()) {
        throw Error("the " + options.driver + " driver needs a port", {}, "give --port");
    }
}

int run(const Options& options) {
    refuse_missing_port(options);
    const Interrupt interrupt;
    std::optional<Controller> controller;
    if (options.driver == "grbl") {
        controller.emplace(options.controller);
    }
    PlannedMachine planned_machine(options);
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
                          : planned_machine.run(job, interrupt.token());
    };
    return run_series(options.series, steps, interrupt.token());
}

} // namespace

void add_run_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("run", "Run the programs of projects on a machine");
    add_series_options(command, options->series, "Project files");
    add_clearance_option(command, options->clearance);
    command.add_option("--driver", options->driver, "Machine to run on")
        ->required()
        ->check(CLI::IsMember({"virtual", "grbl", "stream", "cordic"}));
    add_controller_options(command, options->controller);
    command.add_option("--period", options->period, "Sampling period of a coordinate stream, s")
        ->type_name("S")
        ->capture_default_str();
    command.add_option("--clock", options->processor_hz, "Clock frequency of the CORDIC processor, Hz")
        ->type_name("HZ")
        ->check(CLI::Range(1.0, 1e11))
        ->capture_default_str();
    add_record_options(command, options->record);
    add_post_options(command, options->post);
    command
        .add_option("--speed",
                    options->speed,
                    "Times real time, of the virtual machine and the CORDIC processor; 0: as fast as it goes")
        ->check(CLI::Validator(fault_of_speed, "0, or 0.01 to 1000"))
        ->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace millwright::app
