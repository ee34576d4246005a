// What the options of `millwright gcode` say: whose program it is, for which machine, how that moves.
#pragma once

#include "app/command_line/posting.h"
#include "app/gcode/gcode_pulses.h"
#include "core/gcode/reader_settings.h"
#include "core/motion/planner.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct GcodeOptions {
    std::string file;
    std::string dialect = "linuxcnc";
    std::string axes = "XYZ"; ///< of a Grbl
    std::string tools;
    std::string parameters;               ///< file of what the controller remembers
    std::vector<std::string> subroutines; ///< folders
    std::string machine;
    std::vector<double> origin;               ///< where the program's zero lies on it: X, Y and perhaps Z, mm
    double path_tolerance = 0.0;              ///< mm; 0: exact path
    std::optional<double> junction_deviation; ///< mm; 0: corners by small steps
    std::optional<int> look_ahead;            ///< moves; 0: all
    std::optional<double> chord_length;       ///< mm; not given: arcs by tolerance
    std::string out;
    PostChoice post;
    PulseOptions pulses;
    bool block_delete = false;
    bool json = false;
};

/// Throws Error for a tool table or a parameter file that cannot be read.
[[nodiscard]] gcode::ReaderSettings reader_settings(const GcodeOptions& options);
[[nodiscard]] motion::PlannerSettings planner_settings(const GcodeOptions& options);

/// A command of `group` that reads a program.
CLI::App& add_reader_options(CLI::App& group,
                             const char* name,
                             const char* text,
                             const std::shared_ptr<GcodeOptions>& options);
/// The machine, and how its motion is planned.
void add_motion_options(CLI::App& command, const std::shared_ptr<GcodeOptions>& options);

} // namespace millwright::app
