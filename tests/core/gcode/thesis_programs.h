// Where the programs of the forming thesis are.
#pragma once

#include <string>

namespace millwright::test {

inline const std::string thesis_simple = "assets/samples/gcode/thesis-simple.ngc";
inline const std::string thesis_space = "assets/samples/gcode/thesis-3d.ngc";
inline const std::string thesis_plate = "assets/samples/gcode/thesis-plate.ngc";

} // namespace millwright::test
