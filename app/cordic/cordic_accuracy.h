// millwright cordic accuracy: proven bounds beside measured errors, and the thesis's experiments as pictures.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_cordic_accuracy(CLI::App& group, Command& chosen);

} // namespace millwright::app
