// millwright plot decode | info | toolpath | play: see docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds the command; where it is meant, `chosen` becomes what is to be done.
void add_plot_command(CLI::App& app, Command& chosen);

/// Adds `play` to the group `plot`: sends a point file to a table, one point per period.
void add_plot_play(CLI::App& group, Command& chosen);

} // namespace millwright::app
