// `millwright arm calibrate`, `amplifier` and `wiring`: what setting up the arm and its controller takes.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds them to the commands about arms.
void add_arm_service_commands(CLI::App& group, Command& chosen);

} // namespace millwright::app
