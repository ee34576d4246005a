// What is made of strokes before they are cut: compensated for the cutter, filled, put into a better order,
// linked. Lengths mm, angles rad.
#pragma once

#include "core/base/progress.h"
#include "core/plot/compensation.h"
#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plot {

/// Of a pen whose level has a cutter or a side of its own.
struct PenCutter {
    int pen = 1;
    CutterSide side = CutterSide::on_line;
    double tool_diameter = 3.0;

    friend bool operator==(const PenCutter&, const PenCutter&) = default;
};

struct StrokePlan {
    CutterSide side = CutterSide::on_line; ///< of closed strokes
    double tool_diameter = 3.0;
    Corners corners = Corners::sharp;
    std::optional<double> hatch_pitch = {}; ///< closed strokes are filled with lines so far apart
    double hatch_angle = 0.0;               ///< to x
    bool hatch_cross = false;
    std::optional<double> contour_pitch = {}; ///< closed strokes are filled with outlines so far apart
    bool order = false;                       ///< reorders and reverses for less travel
    double link = 0.0;                        ///< joins over gaps shorter than this; 0: none
    bool link_inside = false;                 ///< links keep to their side of the closed strokes as drawn
    std::vector<PenCutter> cutters = {};      ///< of pens that have another side or diameter

    /// Side and diameter that count for one pen, without others.
    [[nodiscard]] StrokePlan of_pen(int pen) const;
    /// Whether any pen is cut beside its line.
    [[nodiscard]] bool compensates() const;

    friend bool operator==(const StrokePlan&, const StrokePlan&) = default;
};

/// With the sides and cutters of `levels` for their pens. Throws Error where two levels of a pen differ in
/// them, and where a tool has two diameters.
[[nodiscard]] StrokePlan with_cutters(StrokePlan plan, const std::vector<Level>& levels);

/// Diameters of the tools of `levels` that have their own, by the tool's number.
[[nodiscard]] std::map<int, double> tool_diameters(const std::vector<Level>& levels);

struct ShapedStrokes {
    Strokes strokes;
    std::size_t open = 0; ///< strokes that are not closed, and stay as they are
};

/// Compensated and hatched, pen by pen; without either, the strokes as they are. Throws Error naming the
/// setting that is out of its range, for a hatch of more than a million lines, and where nothing is left.
[[nodiscard]] ShapedStrokes shaped(const Strokes& drawn, const StrokePlan& plan);

/// The shaped strokes, linked as planned. Throws Error as link().
[[nodiscard]] Strokes linked(const Strokes& shaped, const Strokes& drawn, const StrokePlan& plan);

/// All of it. Throws Error as above, or Cancelled.
[[nodiscard]] ShapedStrokes
planned(const Strokes& drawn, const StrokePlan& plan, const Progress& progress = Progress());

// What a person should know of strokes that were to be compensated or filled.

/// One line on those of the drawing that are not closed and stay as they are, and on parts of it that the
/// tool does not fit into; empty: there are none, or nothing was asked for.
[[nodiscard]] std::string
unprocessed_strokes(const Strokes& drawn, const ShapedStrokes& shaped, const StrokePlan& plan);

} // namespace millwright::plot
