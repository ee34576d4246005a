// millwright cordic sew: a program as the stitches of a sewing machine, and what it could not keep up with.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_sew(CLI::App& group, Command& chosen);

} // namespace millwright::app
