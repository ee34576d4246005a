// `millwright reshape`: patches of a project by other control points, the shape kept.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_reshape_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
