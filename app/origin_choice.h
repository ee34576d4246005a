// Where the zero of a G-code program lies on a machine, on the command line.
#pragma once

#include "core/geometry/vectors.h"

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// Throws Error where `origin`, given by `name`, has no Z and a program goes to machine positions.
void expect_whole_origin(const std::vector<double>& origin,
                         bool machine_positions,
                         const std::string& name = "--origin");

/// Adds --origin X,Y or X,Y,Z to `command`, by another `name` where that is taken.
void add_origin_option(CLI::App& command, std::vector<double>& origin, const std::string& name = "--origin");

/// Zero where none was given; mm.
[[nodiscard]] Vec3 origin_from(const std::vector<double>& given);

} // namespace millwright::app
