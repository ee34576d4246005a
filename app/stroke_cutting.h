// From strokes to a program, as the command line has it: compensated, hatched, ordered, linked, in levels.
#pragma once

#include "app/cutting.h"
#include "core/plot/compensation.h"
#include "core/plot/cut_path.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

struct StrokeCutting {
    CuttingOptions cutting;
    plot::CutterSide side = plot::CutterSide::on_line;
    double tool_diameter = 3.0;
    plot::Corners corners = plot::Corners::sharp;
    std::optional<double> hatch_pitch;
    double hatch_angle_deg = 0.0;
    bool hatch_cross = false;
    std::optional<double> contour_pitch;
    bool order = false;
    double link = 0.0; ///< mm; 0: none
    bool link_inside = false;
    double depth = 1.0;
    int passes = 1;
    plot::Tabs tabs = {};
    std::vector<std::string> levels;
};

void add_stroke_options(CLI::App& command, StrokeCutting& options);

/// Writes the program, and says after each step how far the tool goes and how long it takes: by the model of
/// the KMITL thesis of 2006 and by the planner. Throws Error.
void cut_strokes(const plot::Strokes& drawn,
                 const StrokeCutting& options,
                 const std::vector<std::string>& header);

} // namespace millwright::app
