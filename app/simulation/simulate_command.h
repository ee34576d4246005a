// millwright simulate: what a program leaves of a stock.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_simulate_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
