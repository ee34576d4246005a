// millwright arm: see docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command with its subcommands; where one is meant, `chosen` becomes what is to be done.
void add_arm_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
