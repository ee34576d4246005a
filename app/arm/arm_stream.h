// millwright arm stream: a motion file through the dual-ported RAM of an emulated card.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_arm_stream_command(CLI::App& group, Command& chosen);

} // namespace millwright::app
