// Programs for any control, on the command line.
#pragma once

#include "core/posts/release.h"

#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace millwright::app {

/// What the options --post, --arcs and --line-numbers say; --tip-tolerance is of `gcode convert` alone.
struct PostChoice {
    std::string post = "linuxcnc"; ///< shipped post or post file
    double arc_tolerance = 0.0;    ///< mm; 0: no arcs
    double tip_tolerance = 0.0;    ///< of ReleaseSettings, mm
    bool line_numbers = false;
};

struct PostedText {
    posts::PostFormat format;
    posts::ReleasedText text;
    bool path_mode_changes = false; ///< of which the text has the first only
};

/// Adds --feed and --plunge, mm/min.
void add_feed_options(CLI::App& command, double& feed, double& plunge);
/// Adds --spindle, rpm.
void add_spindle_option(CLI::App& command, double& speed);
/// Adds them to `command`; returns --post.
CLI::Option& add_post_options(CLI::App& command, PostChoice& choice);

/// Written and read back. `name` stands in the text where the control wants one, `remark` in a comment at its
/// top. Throws Error.
[[nodiscard]] PostedText posted(const program::Program& program,
                                const kinematics::MachineModel& machine,
                                const PostChoice& choice,
                                const std::string& name,
                                const std::string& remark = {});

/// What a person should know about it, on standard error.
void print_notes(const PostedText& posted);

} // namespace millwright::app
