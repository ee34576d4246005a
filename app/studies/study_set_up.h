// millwright study set-up: where on the table the part of a project is cut best.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_study_set_up_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
