// `millwright arm reach`: how much of a program an arm can go, with the part standing in front of it.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds it to the commands about arms.
void add_arm_reach_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
