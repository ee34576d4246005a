// The post-processor: a tool path and its axis positions become a program for the machine, with a safe
// approach, links between the tracks and a safe retract. The tool is a point at the end of its axis
// (Parasilmongkol 1997, KMITL, ch. 3): clearances are those of the tip. Feeds: docs/reference/gcode.md.
#pragma once

#include "core/base/progress.h"
#include "core/program/program.h"
#include "core/program/program_settings.h"
#include "core/program/retract.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/toolpath.h"

#include <string>
#include <vector>

namespace millwright::program {

/// One line about what produced the program, written as `label: text` on its top.
struct HeaderLine {
    std::string label;
    std::string text;
};

/// What the post-processor had to decide, for the report.
struct PostNotes {
    int cut_moves = 0;
    int slowed_moves = 0;      ///< feed moves slower than asked for, because an axis is at its top speed
    int links = 0;             ///< lifted or on the surface
    int raised_links = 0;      ///< lifted higher than link_clearance to stay clear of the part
    int safe_height_links = 0; ///< by way of the safe position
    double cut_length = 0.0;   ///< of the tip's real path on the part, mm

    friend bool operator==(const PostNotes&, const PostNotes&) = default;
};

struct PostResult {
    Program program;
    PostNotes notes;
};

/// Rapids and links stay at least half their clearance above the part, measured against the tangent plane of
/// the nearest path point; each is followed through the forward kinematics. Every target is rounded to the
/// decimals that are written. Throws Error for settings out of range, an axis outside its limits (with block,
/// axis, value and range), or an approach that would cut through the part. Throws Defect if `axes` does not
/// belong to `toolpath` or the tool path is empty. Throws Cancelled through `progress` within one move.
[[nodiscard]] PostResult post(const kinematics::MachineModel& machine,
                              const toolpath::Toolpath& toolpath,
                              const toolpath::AxisPath& axes,
                              const ProgramSettings& settings,
                              const std::vector<HeaderLine>& header,
                              const Progress& progress = Progress());

} // namespace millwright::program
