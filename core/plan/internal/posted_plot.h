// The text of a path that is cut: posted for the machine and the control of the plot's settings, and read
// back.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/plan/plot_work.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/finished_look.h"
#include "core/posts/post_format.h"
#include "core/posts/release.h"

#include <filesystem>

namespace millwright::plan {

struct PostedPlot {
    kinematics::MachineModel machine;
    posts::PostFormat format;
    posts::ReleasedText released;
    std::filesystem::path file; ///< its name in diagnostics
};

/// What cuts it.
[[nodiscard]] plot::ToolTips tips_of(const PlotResult& result);

/// With the settings and the spindle of `result`. Throws Error.
[[nodiscard]] PostedPlot
posted_plot(const PlotResult& result, const plot::CutPath& path, const std::filesystem::path& assets);

} // namespace millwright::plan
