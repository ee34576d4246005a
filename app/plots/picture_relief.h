// `millwright picture relief`: a picture cut as deep as its pixels say.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_picture_relief(CLI::App& group, Command& chosen);

} // namespace millwright::app
