// millwright machine: what there is to know and make of a machine.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command; where it is meant, `chosen` becomes what is to be done.
void add_machine_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
