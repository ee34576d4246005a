// A tool as a person describes it: what cuts, what holds it, how it leans. mm and deg.
#pragma once

#include "core/toolpath/cutter.h"

namespace millwright::project {

/// By default a point along the surface normal.
struct ToolInput {
    toolpath::CutterKind cutter = toolpath::CutterKind::point;
    double diameter_mm = 6.0;
    double corner_radius_mm = 1.0;   ///< of a bull nose's corner, of a cone's tip
    double half_angle_deg = 6.0;     ///< of a cone
    double length_mm = 40.0;         ///< from the tip to the holder
    int number = 1;                  ///< of T and H in the program; 0: no tool is called
    double gauge_length_mm = 0.0;    ///< from the spindle's gauge line to the tip; 0: as in gauge_length_mm()
    double holder_diameter_mm = 0.0; ///< 0: no holder
    double holder_length_mm = 50.0;
    double lead_deg = 0.0;        ///< forward, at the start of each track
    double tilt_deg = 0.0;        ///< to the right of the move
    double lead_change_deg = 0.0; ///< up to the end of the track
    double tilt_change_deg = 0.0;
    double scallop_mm = 0.01;    ///< that may be left between tracks
    double gouge_limit_mm = 0.1; ///< moves that cut deeper than this below the surface are reported

    friend bool operator==(const ToolInput&, const ToolInput&) = default;
};

} // namespace millwright::project
