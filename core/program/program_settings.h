// What a person chooses about a program. Inside the core mm, s, mm/s; people see mm/min.
#pragma once

#include <optional>

namespace millwright::program {

/// How the tool gets from the end of a track to the start of the next one.
enum class LinkKind {
    lifted,    ///< off the part along the tool axis, across, and back down
    on_surface ///< like a cut
};

struct ProgramSettings {
    double cutting_feed = 20.0; ///< of the tool tip on the part, mm/s, > 0
    double plunge_feed = 5.0;   ///< towards the part, mm/s, > 0
    LinkKind link = LinkKind::lifted;
    double link_clearance = 5.0;      ///< lift of a link above the part, mm, > 0; raised where not clear
    double approach_clearance = 10.0; ///< above the first and last pose, mm, > 0
    /// Position of the axis that pulls the tool off (retract.h) where everything else may move, mm.
    /// Not given: its travel limit.
    std::optional<double> safe_position;
    double spindle_rpm = 8000.0; ///< >= 0; 0 leaves the spindle alone
    bool coolant = false;
    double path_tolerance = 0.005; ///< by which a controller may round corners, mm; 0: exact path (G61)
    int length_decimals = 4;       ///< 1 to 6, of mm
    int angle_decimals = 4;        ///< 1 to 6, of degrees
    bool line_numbers = false;

    friend bool operator==(const ProgramSettings&, const ProgramSettings&) = default;
};

/// Throws Error naming the first setting that is out of its range.
void check(const ProgramSettings& settings);

} // namespace millwright::program
