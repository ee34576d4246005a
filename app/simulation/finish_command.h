// `millwright finish`: a program that finishes a mesh as it is, without a surface fitted to it.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_finish_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
