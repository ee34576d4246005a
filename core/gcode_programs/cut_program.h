// A G-code program of X, Y and Z for the plot stages: where its tool cuts and where it travels as a path,
// and seen from above as strokes. Source: KMITL master's thesis of 2006 on forming software, G-code to X-Y-Z.
// Lengths mm, speeds mm/s, times s.
#pragma once

#include "core/base/error.h"
#include "core/gcode/parameter_file.h"
#include "core/gcode/tool_table.h"
#include "core/gcode_programs/work_origin.h"
#include "core/kinematics/machine_model.h"
#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::gcode {

// A machine of X, Y and Z without limits: of what has no other axes and plans nothing.

[[nodiscard]] inline kinematics::MachineModel xyz_machine() {
    kinematics::MachineDescription description;
    description.name = "X, Y, Z";
    for (int n = 0; n < 3; ++n) {
        kinematics::MachineAxis axis;
        axis.letter = "XYZ"[n];
        axis.direction = Vec3::Unit(n);
        axis.max_velocity = 1.0; // nothing is planned for it
        axis.max_acceleration = 1.0;
        description.head.push_back(axis);
    }
    return kinematics::MachineModel(std::move(description));
}

struct CutProgramSettings {
    std::optional<ToolTable> tools{};     ///< not given: any, of unknown length and diameter
    bool block_delete = false;            ///< lines that begin with / are left out
    double chord_tolerance = 0.002;       ///< of arcs and splines
    std::optional<double> chord_length{}; ///< arcs by the rule of the thesis instead: MachineProgramSettings
    /// At and above it a feed across is in the air. Not given: the greatest height at which the program goes
    /// across at rapid, unless it cuts nothing below.
    std::optional<double> safe_height{};
    Parameters parameters{}; ///< that the controller remembers
    std::optional<WorkOrigin>
        origin{}; ///< where the program's zero lies on the machine; not given: not known
};

/// What is cut with one tool at one height. Its strokes have its pen.
struct CutLevel {
    int pen = 1; ///< counted from 1, in the order of the program
    int tool = 1;
    std::optional<double> z; ///< not given: it changes along the strokes
    double cutting = 0.0;    ///< feed of the first stroke
    double plunging = 0.0;   ///< feed of the way down to it; its own where there is none

    friend bool operator==(const CutLevel&, const CutLevel&) = default;
};

struct CutProgram {
    /// Every move from the first place that the program names in X, Y and Z on, with its height and feed.
    plot::CutPath path;
    bool lowers_unasked = false; ///< the program names no height: the path's first two points lower the tool
    /// Runs of feeds across, below the safe height; a way down alone is a dot.
    plot::Strokes strokes;
    std::vector<CutLevel> levels;       ///< of the strokes
    std::optional<Diagnostic> uneven{}; ///< the first stroke that has not one height, with its line
    std::optional<double> safe_height;  ///< that counts; nothing where all feeds across are cuts
    Vec2 end = Vec2::Zero();            ///< where the program leaves the tool
    int lines = 0;
    double feed_time = 0.0;          ///< of all feeds, as programmed
    double dwell_time = 0.0;         ///< in which it stands
    double spindle_rpm = 0.0;        ///< the first that it is switched on with, or else that is set; 0: none
    std::vector<Diagnostic> notices; ///< what is read in another way, and what a path has no record of
    /// MachineProgram::unplaced, and a first cut from where X or Y is not known (it is taken for 0): who cuts
    /// this refuses; they are among the notices, too.
    std::vector<Diagnostic> unplaced;
};

/// The program `text`, called `file` in diagnostics. Throws Error with the line for the first thing that is
/// wrong in it or that X, Y and Z cannot do: other axes, no feed, probing, compensation by a tool of unknown
/// diameter; for more moves than a path may have; and where it cuts nothing.
[[nodiscard]] CutProgram read_cut_program(std::string_view text,
                                          const std::filesystem::path& file,
                                          const CutProgramSettings& settings = {});

/// The file itself, line by line; subroutines are looked for in its folder. Throws Error if it cannot be
/// read, too.
[[nodiscard]] CutProgram read_cut_program_file(const std::filesystem::path& file,
                                               const CutProgramSettings& settings = {});

/// Of its path, without the way down that the program does not say.
[[nodiscard]] plot::PathLengths named_lengths(const CutProgram& program);

/// Whether the text begins as G-code does: its first line that is no comment is one of words.
[[nodiscard]] bool is_gcode(std::string_view text);

} // namespace millwright::gcode
