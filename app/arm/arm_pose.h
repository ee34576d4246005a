// millwright arm fk, ik: see docs/reference/cli.md.
#pragma once

#include "app/command_line/command.h"

#include <CLI/App.hpp>

namespace millwright::app {

void add_arm_pose_commands(CLI::App& group, Command& chosen);

} // namespace millwright::app
