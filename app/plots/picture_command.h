// `millwright picture`: pictures that are cut: reliefs, traced outlines, V-carvings, dots. Each of its
// commands adds itself to the group.
#pragma once

#include "app/command_line/command.h"

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

void add_picture_command(CLI::App& app, Command& chosen);

/// `millwright picture carve`: what is dark in a picture, V-carved.
void add_picture_carve(CLI::App& group, Command& chosen);

/// `millwright picture engrave`: a picture as dots.
void add_picture_engrave(CLI::App& group, Command& chosen);

/// `millwright picture relief`: a picture cut as deep as its pixels say.
void add_picture_relief(CLI::App& group, Command& chosen);

/// `millwright picture trace`: outlines of what is dark, as an SVG or as a program.
void add_picture_trace(CLI::App& group, Command& chosen);

} // namespace millwright::app
