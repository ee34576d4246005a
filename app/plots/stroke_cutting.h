// From strokes to a program, as the command line has it: compensated, hatched, ordered, linked, in levels.
#pragma once

#include "app/plots/cutting.h"
#include "core/plot/cut_path.h"
#include "core/plot/stroke_plan.h"
#include "core/plot/work_time.h"

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
    std::vector<double> change_position;   ///< on the machine; empty: 0,0,25
    std::vector<plot::Level> drawn_levels; ///< what the drawing itself says of its pens; others: as above
};

/// Both lengths and their sum in m, and the lifts: "0.043 m (0.040 m drawn, 0.003 m in the air), 1 lift".
[[nodiscard]] std::string way_for_people(const plot::WorkTime& time);

void add_stroke_options(CLI::App& command, StrokeCutting& options);

/// Writes the program, and says after each step how far the tool goes and how long it takes: by the model of
/// the KMITL thesis of 2006 and by the planner. `end` is where the drawing leaves the pen. Throws Error, or
/// Cancelled.
void cut_strokes(const plot::Strokes& drawn,
                 const Vec2& end,
                 const StrokeCutting& options,
                 const std::vector<std::string>& header,
                 const Progress& progress = Progress());

} // namespace millwright::app
