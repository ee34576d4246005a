// millwright [PROJECT]: the window.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// What is done where no command is named.
void add_workbench_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
