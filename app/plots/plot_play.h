// `millwright plot play`: sends a point file to a table, one point a period.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// Adds it to the group `plot`.
void add_plot_play(CLI::App& group, Command& chosen);

} // namespace millwright::app
