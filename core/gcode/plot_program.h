// The program of a 3-axis machine that cuts a plot.
#pragma once

#include "core/gcode/program.h"
#include "core/plot/cut_path.h"

#include <string>
#include <vector>

namespace millwright::gcode {

struct PlotProgramSettings {
    std::string machine = "XYZ";     ///< the name that the program carries
    std::vector<std::string> header; ///< comments on its top
    double spindle_rpm = 10'000.0;   ///< 0 leaves the spindle alone
    int length_decimals = 4;         ///< targets are rounded to them, as they are written
};

/// Axes X, Y, Z. Rapids go where the path travels, up before across; each change of tool stops the spindle
/// and waits for a person. Points that rounding makes equal are left out. Throws Defect if a point is not
/// finite.
[[nodiscard]] Program plot_program(const plot::CutPath& path, const PlotProgramSettings& settings = {});

} // namespace millwright::gcode
