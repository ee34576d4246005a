// The program of a 3-axis machine that cuts a plot.
#pragma once

#include "core/base/error.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/finished_look.h"
#include "core/program/program.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plot {

/// A point takes about 0.8 kB while its program is written, read back and planned.
inline constexpr std::size_t most_program_points = 4'000'000;

struct PlotProgramSettings {
    std::string machine = "XYZ";          ///< the name that the program carries
    std::string axes = "XYZ";             ///< these three, in the order of the machine's axes
    std::vector<std::string> header = {}; ///< comments on its top
    double spindle_rpm = 10'000.0;        ///< 0 leaves the spindle alone
    int length_decimals = 4;              ///< targets are rounded to them, as they are written
    std::optional<ToolTips> tips = {};    ///< what cuts; not given: the program does not say
};

/// Throws Error for the first axis that cannot go where the path does, which was moved by `origin`; its hint
/// says which origin would do, if any does. Heights are left to those who write the program.
void expect_on_table(const CutPath& path,
                     const kinematics::MachineModel& machine,
                     const Vec2& origin = Vec2::Zero());

/// What a person should know: the first speed for which an axis would have to be faster than it can, and how
/// many moves are so. They are executed slower; nothing if there is none.
[[nodiscard]] std::optional<Diagnostic> speeds_not_reached(const CutPath& path,
                                                           const kinematics::MachineModel& machine);

/// The letters of a machine's axes, for PlotProgramSettings. Throws Error unless they are X, Y and Z.
[[nodiscard]] std::string plot_axes(const kinematics::MachineModel& machine);

/// Each block tells the point of the path where it ends, from 0. Rapids go where the path travels, up before
/// across. The first tool is named at the start; a program that changes tools waits for a person there, and
/// at each change, with the spindle stopped. Points that rounding makes equal are left out. Throws Error for
/// a path longer than most_program_points, Defect if a point is not finite, or for other axes.
[[nodiscard]] program::Program plot_program(const CutPath& path, const PlotProgramSettings& settings = {});

} // namespace millwright::plot
