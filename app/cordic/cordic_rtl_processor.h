// millwright cordic rtl-processor: the whole processor as Verilog, with a bench that compares it with the
// model.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_rtl_processor(CLI::App& group, Command& chosen);

} // namespace millwright::app
