// A machine that is moved position by position, on the command line: one that follows a motion that is
// planned here, or one that is given each move.
#pragma once

#include "app/command_line/record_choice.h"
#include "app/drivers/connected_controller.h"
#include "core/base/clock.h"
#include "core/cordic_machine/cordic_driver.h"
#include "core/drivers/driver.h"
#include "core/jobs/job.h"

#include <memory>
#include <stop_token>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// What the options --driver, --speed, --period and those of records and controllers say.
struct PlannedMachineChoice {
    std::string driver = "virtual"; ///< or cordic, stream, records
    double speed = 1.0;             ///< times real time; 0: as fast as it goes
    double period = 0.01;           ///< of a coordinate stream, s
    double processor_hz = cordic_machine::CordicDriverOptions().clock_hz;
    std::optional<gcode::WorkOrigin> origin{}; ///< of what the CORDIC processor executes
    RecordChoice record;                       ///< of a coordinate stream, and of records
    ControllerChoice controller;               ///< port of these, keys, optional stops
};

/// Adds --speed, --period, --clock and those of records to `command`.
void add_planned_machine_options(CLI::App& command, PlannedMachineChoice& choice);

/// Throws Error for what is missing or too much, before any work is done.
void check(const PlannedMachineChoice& choice);

/// Throws Error for a machine that begins programs at their first line alone.
void check_from_line(const PlannedMachineChoice& choice, int from_line);

/// Runs jobs one after another, over one connection; the first says which machine it is.
class PlannedMachine {
public:
    /// `choice` must outlive it.
    explicit PlannedMachine(const PlannedMachineChoice& choice) : choice_(choice) {}

    /// Under a progress bar. Throws Error, before anything moves if the job is at fault.
    [[nodiscard]] jobs::JobOutcome
    run(const jobs::Job& job, const std::string& log_folder, const Interrupt& interrupt);

private:
    void connect(const jobs::Job& job);
    /// What the CORDIC processor did otherwise than the job says, and too late.
    void tell_remarks(const jobs::Job& job) const;
    [[nodiscard]] std::unique_ptr<drivers::Driver> make_driver(const jobs::Job& job);

    const PlannedMachineChoice& choice_;
    SteadyClock clock_;
    std::string model_; ///< name of the machine that the driver moves
    std::unique_ptr<drivers::Driver> driver_;
    const cordic_machine::CordicDriver* cordic_ = nullptr; ///< the same, if it is one
};

} // namespace millwright::app
