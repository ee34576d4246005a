// millwright cordic asm, disasm, microprogram: programs of the CORDIC processor as bytes and as text.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_programs(CLI::App& group, Command& chosen);

} // namespace millwright::app
