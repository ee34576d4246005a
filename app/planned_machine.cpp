#include "app/planned_machine.h"

#include "app/job_keys.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/make_driver.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>

namespace millwright::app {

PlannedMachine::PlannedMachine(const PlannedChoice& choice) : choice_(choice) {
    const bool takes_records = choice.driver == "stream" || choice.driver == "records";
    if (!choice.record.pattern.empty() && !takes_records) {
        throw Error("records are for the stream and records drivers");
    }
    if (takes_records && choice.port.empty()) {
        throw Error("the " + choice.driver + " driver needs a port", {}, "give --port");
    }
}

PlannedMachine::~PlannedMachine() = default;

machine::JobOutcome
PlannedMachine::run(const machine::Job& job, const std::string& log_folder, const std::stop_token& stop) {
    connect(job);
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
    machine::Dispatcher dispatcher(*driver_, clock_, log_folder);
    const JobKeys keys(dispatcher, choice_.keys);
    machine::JobOutcome outcome = dispatcher.run(job, progress);
    if (const std::string late = cordic_ == nullptr ? "" : cordic_->remark(); !late.empty()) {
        fmt::print(stderr, "millwright: {}: {}\n", job.name, late);
    }
    return outcome;
}

void PlannedMachine::connect(const machine::Job& job) {
    if (driver_ != nullptr) {
        if (job.machine->name() != model_) {
            throw Error(fmt::format("{} is for machine '{}', and '{}' is connected",
                                    job.project,
                                    job.machine->name(),
                                    model_),
                        {},
                        "run it by itself");
        }
        return;
    }
    machine::DriverChoice wanted;
    wanted.kind = machine::driver_kind(choice_.driver);
    wanted.address = choice_.port;
    wanted.period = choice_.period;
    RecordChoice record = choice_.record;
    if (choice_.driver == "records" && record.pattern.empty()) {
        record.pattern = machine::RecordFormat().pattern;
    }
    wanted.record = record_of(record);
    if (wanted.kind == machine::DriverKind::cordic) {
        machine::CordicDriverOptions processor;
        processor.clock_hz = choice_.processor_hz;
        auto made = std::make_unique<machine::CordicDriver>(
            job.program->start, machine::VirtualSpeed{choice_.speed}, clock_, job.machine, processor);
        cordic_ = made.get();
        driver_ = std::move(made);
    } else {
        driver_ = machine::make_driver(wanted, {job.machine, job.program->start, choice_.speed}, clock_);
    }
    model_ = job.machine->name();
    driver_->connect();
}

} // namespace millwright::app
