// `millwright picture`: pictures that are cut: reliefs, traced outlines, V-carvings, dots.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_picture_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
