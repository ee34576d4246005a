// From strokes to a program, as the command line has it: compensated, hatched, ordered, linked, in levels.
#pragma once

#include "app/cutting.h"
#include "core/plot/cut_path.h"
#include "core/plot/stroke_plan.h"

#include <string>
#include <vector>

namespace millwright::app {

struct StrokeCutting {
    CuttingOptions cutting;
    plot::StrokePlan plan = {}; ///< without the angle of the hatch
    double hatch_angle_deg = 0.0;
    double depth = 1.0;
    int passes = 1;
    plot::Tabs tabs = {};
    std::vector<std::string> levels;
};

void add_stroke_options(CLI::App& command, StrokeCutting& options);

/// Writes the program, and says after each step how far the tool goes and how long it takes: by the model of
/// the KMITL thesis of 2006 and by the planner. Throws Error, or
/// Cancelled.
void cut_strokes(const plot::Strokes& drawn,
                 const StrokeCutting& options,
                 const std::vector<std::string>& header,
                 const Progress& progress = Progress());

} // namespace millwright::app
