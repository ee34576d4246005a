#include "app/drivers/planned_machine.h"

#include "app/command_line/command.h"
#include "app/command_line/option_values.h"
#include "app/drivers/job_terminal.h"
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/machine/drivers_by_name.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

std::string fault_of_speed(const std::string& text) {
    using drivers::VirtualSpeed;
    double speed = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), speed);
    const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
    const bool inside = speed >= VirtualSpeed::slowest && speed <= VirtualSpeed::fastest;
    return whole && (inside || exactly_equal(speed, VirtualSpeed::unlimited))
               ? std::string()
               : fmt::format("'{}' must be 0 or between {} and {}",
                             text,
                             VirtualSpeed::slowest,
                             VirtualSpeed::fastest);
}

} // namespace

void add_planned_machine_options(CLI::App& command, PlannedMachineChoice& choice) {
    command.add_option("--period", choice.period, "Sampling period of a coordinate stream, s")
        ->type_name("S")
        ->check(finite_number())
        ->capture_default_str();
    add_record_options(command, choice.record);
    command
        .add_option("--speed",
                    choice.speed,
                    "Speed of the virtual machine or the CORDIC processor, times real time: 0.01 to 1000; 0: "
                    "as fast as possible")
        ->type_name("X")
        ->check(CLI::Validator(fault_of_speed, ""))
        ->capture_default_str();
    command.add_option("--clock", choice.processor_hz, "Clock frequency of the CORDIC processor, Hz")
        ->type_name("HZ")
        ->check(CLI::Range(1.0, 1e11))
        ->capture_default_str();
}

void check(const PlannedMachineChoice& choice) {
    const machine::DriverRow& row = machine::driver_row(choice.driver);
    if (!choice.record.pattern.empty() && row.kind != machine::MachineKind::positioned) {
        throw UsageError("--record applies only to the stream and records drivers");
    }
    if (row.address && choice.controller.port.empty()) {
        throw UsageError("the " + choice.driver + " driver needs a port", {}, "give --port");
    }
}

void check_from_line(const PlannedMachineChoice& choice, int from_line) {
    if (from_line > 1 && choice.driver == "cordic") {
        throw Error("the cordic driver can only run programs from the beginning");
    }
}

jobs::JobOutcome
PlannedMachine::run(const jobs::Job& job, const std::string& log_folder, const Interrupt& interrupt) {
    connect(job);
    JobPrinter printer;
    bool begun = false; // from then on the report says more
    const Progress progress(
        [&](const Progress::Report& report) {
            if (!begun) {
                printer.show(report);
            }
        },
        interrupt.token());
    bool cut = false;
    jobs::Dispatcher dispatcher(*driver_, clock_, log_folder);
    const JobKeys keys(dispatcher, choice_.controller.keys, choice_.controller.stops);
    jobs::JobOutcome outcome = dispatcher.run(job, progress, [&](const jobs::JobReport& report) {
        begun = true;
        if (interrupt.insisted() && !std::exchange(cut, true)) {
            driver_->emergency_stop();
        }
        printer.show(report, keys.listening());
    });
    tell_remarks(job);
    return outcome;
}

void PlannedMachine::tell_remarks(const jobs::Job& job) const {
    if (cordic_ == nullptr) {
        return;
    }
    std::vector<Diagnostic> warnings = cordic_->warnings();
    for (Diagnostic& warning : warnings) {
        warning.place.file = job.name;
    }
    print_warnings(warnings);
    if (const std::string late = cordic_->remark(); !late.empty()) {
        fmt::print(stderr, "millwright: {}: {}\n", job.name, late);
    }
}

void PlannedMachine::connect(const jobs::Job& job) {
    if (driver_ == nullptr) {
        model_ = job.machine->name();
        driver_ = make_driver(job);
        driver_->connect();
        driver_->set_optional_stop(choice_.controller.stops.optional_stop);
        driver_->set_single_block(choice_.controller.stops.single_block);
    } else if (job.machine->name() != model_) {
        throw Error(
            fmt::format(
                "{} is for machine '{}', but '{}' is connected", job.project, job.machine->name(), model_),
            {},
            "run it in a separate command");
    }
}

std::unique_ptr<drivers::Driver> PlannedMachine::make_driver(const jobs::Job& job) {
    machine::DriverChoice choice;
    choice.driver = choice_.driver;
    choice.address = choice_.controller.port;
    choice.period = choice_.period;
    if (choice.driver == "cordic") {
        cordic_machine::CordicDriverOptions processor;
        processor.clock_hz = choice_.processor_hz;
        processor.origin = choice_.origin;
        auto made = std::make_unique<cordic_machine::CordicDriver>(
            job.program->start, drivers::VirtualSpeed{choice_.speed}, clock_, job.machine, processor);
        cordic_ = made.get();
        return made;
    }
    RecordChoice record = choice_.record;
    if (choice_.driver == "records" && record.pattern.empty()) {
        record.pattern = drivers::RecordFormat().pattern;
    }
    choice.record = record_of(record);
    return machine::make_driver(choice, {job.machine, job.program->start, choice_.speed}, clock_);
}

} // namespace millwright::app
