// The cordic commands about the thesis's speed experiment: compare and sew.
#pragma once

#include "app/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_compare(CLI::App& group, Command& chosen);

} // namespace millwright::app
