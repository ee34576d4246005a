// `millwright plot` of a G-code program: the same commands by the same stages, with the heights that it has.
#pragma once

#include "app/plots/stroke_cutting.h"
#include "core/gcode_programs/cut_program.h"
#include "core/plot/decode.h"
#include "core/plot/stroke_svg.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// How a program is read. Not given: as its options say nothing.
struct ProgramReading {
    std::string tools, parameters;
    std::vector<double> origin; ///< as add_origin_option() has it
    std::optional<double> chord_length;
    std::optional<double> chord_tolerance;
    std::optional<double> safe_height;
};

/// Those that plots do not have, to a command that reads plots.
void add_program_options(CLI::App& command, ProgramReading& reading);

/// Whether `file` is to be read as points; pipes never are. Throws UsageError for options of `command` that
/// are for other files.
[[nodiscard]] bool takes_points(const CLI::App& command, const std::string& file);

/// Whether `file` is to be read as a program; pipes never are. Throws UsageError for options of `command`
/// that are for the other kind of file.
[[nodiscard]] bool takes_program(const CLI::App& command, const std::string& file);

/// Each throws Error as read_cut_program() and says on standard error what is left out.
int program_info(const std::string& file, const ProgramReading& reading, bool json);
int program_view(const std::string& file,
                 const ProgramReading& reading,
                 plot::AirInSvg air,
                 const std::string& out);
/// `flat`: at the heights of the pen in `decoding`, not at the program's.
[[nodiscard]] std::vector<Vec3> program_points(const std::string& file,
                                               const ProgramReading& reading,
                                               plot::DecodeSettings decoding,
                                               const std::optional<double>& fastest,
                                               bool flat);
struct ProgramStrokes {
    plot::Strokes strokes;
    double safe_height = 0.0; ///< at which the program goes across, at least the usual one, mm
};
/// What it cuts, whatever the height. Says on standard error where it travels higher than usual. Throws Error
/// as read_cut_program(), and if its position is unknown.
[[nodiscard]] ProgramStrokes program_strokes(const std::string& file, const ProgramReading& reading);
/// As it stands, or anew of its strokes where an option of `command` shapes these.
int program_toolpath(const std::string& file,
                     const ProgramReading& reading,
                     StrokeCutting cutting,
                     const CLI::App& command);

} // namespace millwright::app
