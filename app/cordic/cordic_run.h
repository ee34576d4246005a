// millwright cordic run: a program on the CORDIC processor, and what it comes to.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_run(CLI::App& group, Command& chosen);

} // namespace millwright::app
