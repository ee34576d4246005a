// millwright cordic: the G-code processor that computes with CORDIC, from single rotations to whole programs.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
