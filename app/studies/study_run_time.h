// `millwright study run-time`: how long the adaptation takes, beside the thesis's tables 7-1 and 7-2 and its
// profile.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_study_run_time_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
