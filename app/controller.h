// A job on a controller that plans for itself, on the command line.
#pragma once

#include "core/machine/job.h"

#include <stop_token>
#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace millwright::app {

/// Which controller, and what the options --port, --one-by-one and --unlock say.
struct ControllerChoice {
    std::string driver = "grbl"; ///< or linuxcnc
    std::string port;
    bool one_by_one = false;
    bool unlock = false;
    std::string axes = "XYZ"; ///< of a LinuxCNC
};

/// Adds these three to `command`; returns --port.
CLI::Option& add_controller_options(CLI::App& command, ControllerChoice& choice);

/// Checks the text, connects, says what a person should know, and runs the job to its end under a progress
/// bar. Throws Error, before anything is sent if the text is at fault.
[[nodiscard]] machine::JobOutcome run_on_controller(const machine::Job& job,
                                                    const ControllerChoice& choice,
                                                    const std::string& log_folder,
                                                    const std::stop_token& stop);

/// Date and time for people.
[[nodiscard]] std::string now_for_people();

} // namespace millwright::app
