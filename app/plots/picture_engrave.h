// `millwright picture engrave`: a picture as dots.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_picture_engrave(CLI::App& group, Command& chosen);

} // namespace millwright::app
