// The text of a path that is cut: posted for the machine and the control of the plot's settings, and read
// back.
#pragma once

#include "core/gcode/posts/post_format.h"
#include "core/gcode/posts/release.h"
#include "core/kinematics/machine_model.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/finished_look.h"
#include "core/project/plot_work.h"

#include <filesystem>

namespace millwright::project {

struct PostedPlot {
    kinematics::MachineModel machine;
    gcode::PostFormat format;
    gcode::ReleasedText released;
    std::filesystem::path file; ///< its name in diagnostics
};

/// What cuts it.
[[nodiscard]] plot::ToolTips tips_of(const PlotResult& result);

/// With the settings and the spindle of `result`. Throws Error.
[[nodiscard]] PostedPlot
posted_plot(const PlotResult& result, const plot::CutPath& path, const std::filesystem::path& assets);

} // namespace millwright::project
