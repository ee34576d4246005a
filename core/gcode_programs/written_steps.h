// What a program's text makes a control do, read from the text alone: to be compared with what was meant.
#pragma once

#include "core/gcode/axes.h"
#include "core/gcode/canon.h"
#include "core/gcode/reader_settings.h"
#include "core/gcode/tool_table.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode {

enum class StepKind {
    rapid,
    feed,
    arc,
    tool, ///< another one is called
    spindle_on,
    spindle_off,
    coolant_on,
    coolant_off,
    dwell,
    pause,
    end
};

struct WrittenStep {
    StepKind kind = StepKind::rapid;
    int line = 0;      ///< from 1
    bool tip = false;  ///< moves, end: under tip control
    AxisValues target; ///< moves: machine positions, or the tip plus the work offset; mm and degrees
    double value =
        0.0; ///< feed, arc: duration, s; dwell: s; spindle: rpm, < 0 counter-clockwise; tool: number
    Plane plane = Plane::xy;
    double centre_1 = 0.0, centre_2 = 0.0; ///< arc: along the plane's first and second axis, machine, mm
    double sweep = 0.0;                    ///< arc: rad, > 0 from the first axis to the second
};

struct WrittenTextRules {
    Dialect dialect = Dialect::linuxcnc;
    std::string grbl_axes = "XYZ"; ///< of a Grbl: letters of its axes
    AxisValues start;              ///< where the axes stand before, machine positions, mm and degrees
    AxisValues work_offset;        ///< mm; distinguishes what leaves it out (G53, M91)
    Tool tool;                     ///< the one in the tool table, with its offset in mm; number 0: none
    /// M codes that switch tip control on and off; 0: none, or those of the dialect.
    int tip_on = 0, tip_off = 0;
};

/// Of RS-274, by the interpreter. Throws Error with line and column for what breaks a rule, or is none of the
/// steps: splines, probing, offsets.
[[nodiscard]] std::vector<WrittenStep>
read_written_rs274(std::string_view text, const std::filesystem::path& file, const WrittenTextRules& rules);

} // namespace millwright::gcode
