// `millwright emulate table`: the other end of a coordinate stream of records.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_emulate_table(CLI::App& group, Command& chosen);

} // namespace millwright::app
