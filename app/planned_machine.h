// A machine that is moved position by position, on the command line: one that follows a motion that is
// planned here, or one that is told each move.
#pragma once

#include "app/record_choice.h"
#include "core/machine/clock.h"
#include "core/machine/driver.h"
#include "core/machine/drivers/cordic/cordic_driver.h"
#include "core/machine/job.h"

#include <memory>
#include <stop_token>
#include <string>

namespace millwright::app {

struct PlannedChoice {
    std::string driver = "virtual"; ///< stream, cordic or records
    std::string port = {};
    double speed = 1.0;                                            ///< of those inside this program
    double period = 0.01;                                          ///< of a coordinate stream, s
    double processor_hz = machine::CordicDriverOptions().clock_hz; ///< clock of the CORDIC processor
    RecordChoice record = {};                                      ///< of a coordinate stream, and of records
    bool keys = false; ///< of JobKeys also from an input that is no terminal
};

/// Connected for the first job, which says which machine it is; the next ones go over the same connection.
class PlannedMachine {
public:
    /// Throws Error, before any work is done, if a port is missing or the driver takes no records.
    explicit PlannedMachine(const PlannedChoice& choice);
    PlannedMachine(const PlannedMachine&) = delete;
    PlannedMachine& operator=(const PlannedMachine&) = delete;
    ~PlannedMachine();

    /// Runs the job to its end under a progress bar; logs go to `log_folder`. Throws Error.
    [[nodiscard]] machine::JobOutcome
    run(const machine::Job& job, const std::string& log_folder, const std::stop_token& stop);

private:
    void connect(const machine::Job& job);

    const PlannedChoice& choice_;
    machine::SteadyClock clock_;
    std::string model_; ///< name of the machine that the driver moves
    std::unique_ptr<machine::Driver> driver_;
    const machine::CordicDriver* cordic_ = nullptr; ///< the same, if it is one
};

} // namespace millwright::app
