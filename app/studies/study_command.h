// millwright study: see docs/reference/cli.md. Its larger commands add themselves to the group.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command; where it is meant, `chosen` becomes what is to be done.
void add_study_command(CLI::App& app, Command& chosen);

/// `study fewest-points`: how few points an error needs.
void add_study_fewest_command(CLI::App& group, Command& chosen);

/// `study run-time`: how long the adaptation takes, beside the thesis's tables 7-1 and 7-2 and its profile.
void add_study_run_time_command(CLI::App& group, Command& chosen);

/// `study set-up`: where on the table the part of a project is cut best.
void add_study_set_up_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
