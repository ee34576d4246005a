// Where the zero of a G-code program lies on a machine, on the command line.
#pragma once

#include "core/gcode_programs/work_origin.h"

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// Adds --origin X,Y or X,Y,Z to `command`, by another `name` where that is taken.
void add_origin_option(CLI::App& command, std::vector<double>& origin, const std::string& name = "--origin");

/// Of two numbers or three, mm; zero where none was given.
[[nodiscard]] gcode::WorkOrigin origin_from(const std::vector<double>& given);

} // namespace millwright::app
