// `millwright thesis`: the files of the thesis's own programs, for comparison with the original.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_thesis_command(CLI::App& app, Command& chosen);

} // namespace millwright::app
