// What commands that make programs for a machine with a spindle and X, Y, Z have in common.
#pragma once

#include "app/command_line/posting.h"
#include "core/base/progress.h"
#include "core/base/units.h"
#include "core/kinematics/machine_model.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/tool_tip.h"
#include "core/project/plot_input.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// How the work looks when it is done, as a picture.
struct PreviewOptions {
    std::string file; ///< PNG; empty: none
    int pixels = 800; ///< of the longer side
    bool against_light = false;
    std::optional<double> plate; ///< its thickness, mm; not given: the depth of the cut and half a millimetre
    bool through = false;        ///< the path may go deeper than a plate whose thickness is given
    std::map<int, double> tool_diameters; ///< of end mills that are not as wide as the usual one, by tool, mm
    double half_light =
        project::PlotSettings().half_light; ///< what halves the light that goes through the plate, mm
};

/// The window's where nothing is said.
struct CuttingOptions {
    std::string out = {};
    PreviewOptions preview = {};
    std::string machine = project::PlotSettings().machine;
    PostChoice post = {.post = project::PlotSettings().post};
    std::string path_file = {};      ///< for the path itself; empty: none
    std::vector<double> origin = {}; ///< where x and y of the drawing begin; empty: at 0, 0
    double feed_mm_per_min = to_mm_per_min(project::PlotSettings().level.cutting);
    double plunge_mm_per_min = to_mm_per_min(project::PlotSettings().level.plunging);
    double safe_height = project::PlotSettings().safe_height;
    double spindle_rpm = project::usual_spindle_rpm;
};

/// Adds --machine, the options of posts and previews, feeds, safe height and spindle to `command`.
void add_cutting_options(CLI::App& command, CuttingOptions& options);

/// Adds --origin X,Y: where the drawing's origin lies on the machine (origin_from).
void add_drawing_origin(CLI::App& command, std::vector<double>& origin);

[[nodiscard]] kinematics::MachineModel machine_of(const CuttingOptions& options);

/// How long the machine takes for it by the planner, s. Throws Error.
[[nodiscard]] double planned_seconds(const plot::CutPath& path,
                                     const CuttingOptions& options,
                                     const Progress& progress = Progress());

/// What was written.
struct WrittenProgram {
    std::size_t points = 0; ///< of the path
    std::size_t lines = 0;
    plot::PathLengths lengths; ///< where it lies on the machine
    double seconds = 0.0;      ///< that the machine takes by the planner
    std::string machine;
};

/// Writes the program to `options.out`, after it was read back, and the preview of what `tip` leaves.
/// `seconds` of the planner if they are known already; `header` stands on its top. Throws Error, or
/// Cancelled.
[[nodiscard]] WrittenProgram write_program_files(const plot::CutPath& path,
                                                 const CuttingOptions& options,
                                                 const plot::ToolTip& tip,
                                                 const std::vector<std::string>& header,
                                                 const Progress& progress = Progress(),
                                                 std::optional<double> seconds = std::nullopt);

/// How many lines it has, how far it goes and how long the machine takes.
void print_program(const WrittenProgram& written);

/// Both.
void write_program(const plot::CutPath& path,
                   const CuttingOptions& options,
                   const plot::ToolTip& tip,
                   const std::vector<std::string>& header,
                   const Progress& progress = Progress(),
                   std::optional<double> seconds = std::nullopt);

} // namespace millwright::app
