// millwright cordic run, asm, disasm, microprogram: whole programs on the CORDIC processor.
#pragma once

#include "app/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_programs(CLI::App& group, Command& chosen);

} // namespace millwright::app
