// millwright study fewest-points: how few points an error needs.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_study_fewest_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
