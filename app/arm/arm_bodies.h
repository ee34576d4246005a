// `millwright arm bodies`: what an arm of the Motoman L-3's kind looks like, as a glb file.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds it to the commands about arms.
void add_arm_bodies_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
