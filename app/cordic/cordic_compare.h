// millwright cordic compare: the thesis's speed experiment.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_compare(CLI::App& group, Command& chosen);

} // namespace millwright::app
