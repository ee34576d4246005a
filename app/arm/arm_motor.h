// `millwright arm offset` and `arm step`: setting up a motor of the arm on its PMAC.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds them to the commands about arms.
void add_arm_motor_commands(CLI::App& group, Command& chosen);

} // namespace millwright::app
