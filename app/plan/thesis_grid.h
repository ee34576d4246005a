// `millwright thesis grid`: the grid of a project, made by any of its methods, in the files of the thesis's
// solver.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_thesis_grid(CLI::App& thesis, Command& chosen);

} // namespace millwright::app
