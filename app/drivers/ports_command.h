// millwright ports: see docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command; where it is meant, `chosen` becomes what is to be done.
void add_ports_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
