// `millwright picture trace`: outlines of what is dark, as an SVG or as a program.
#pragma once

#include "app/command_line/command.h"

namespace CLI {

class App;

} // namespace CLI

namespace millwright::app {

void add_picture_trace(CLI::App& group, Command& chosen);

} // namespace millwright::app

namespace CLI {

// `millwright picture carve`: what is dark in a picture, V-carved.

class App;

} // namespace CLI

namespace millwright::app {

void add_picture_carve(CLI::App& group, Command& chosen);

} // namespace millwright::app
