// Jobs for a table that plays points: what a plot's path cuts at constant velocity, and point files as they
// are. Lengths mm, speeds mm/s, times s.
#pragma once

#include "core/jobs/job.h"
#include "core/plot/cut_path.h"
#include "core/plot/decode.h"
#include "core/plot/point_file.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::jobs {

struct PathPoints {
    plot::DecodeSettings decoding; ///< heights and end of the pen do not count, those of the path do
    /// Where the table is; not given: above zero, at the height of the path's first point.
    std::optional<Vec3> start = {};
    double speed = 1.0;       ///< times real time, at which the table is sent the points
    double spindle_rpm = 0.0; ///< of its program
};

/// The program of the path, as plot_program() makes it, and its points: the same strokes in the same order at
/// the same depths, with a stop at each tool change. `file` is what the path was made of. Throws Error for
/// what decode_path() and plot_program() refuse, and for another machine than one with X, Y and Z alone.
[[nodiscard]] Job path_points_job(const plot::CutPath& path,
                                  const std::filesystem::path& file,
                                  std::shared_ptr<const kinematics::MachineModel> machine,
                                  const PathPoints& settings);

/// Where a path starts to be played if the place of the table is not known, mm.
[[nodiscard]] Vec3 usual_start(const plot::CutPath& path);

/// The points of a file, each a block on its line. Throws Error for a machine without X, Y, Z, without any
/// point, and for more than a program can have (plot::most_program_points).
[[nodiscard]] Job point_file_job(std::string_view text,
                                 const plot::PointFile& read,
                                 const std::filesystem::path& file,
                                 std::shared_ptr<const kinematics::MachineModel> machine,
                                 double period);

} // namespace millwright::jobs
