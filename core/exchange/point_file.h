// Measured points from text files, one point per line: x y z, separated by white space, commas or semicolons.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/vectors.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::exchange {

inline constexpr std::size_t most_measured_points = 1'000'000;

struct MeasuredPoints {
    std::vector<Vec3> points;         ///< in the unit of the file
    std::vector<int> lines;           ///< of the file, from 1; one per point
    std::vector<std::size_t> begins;  ///< first point of each block; blank lines end a block
    std::vector<std::string> notes{}; ///< what of the file is not read, a sentence each
};

/// Whether the name ends like that of a file of points (.csv, .xyz, .asc, .pts, .txt), in any case.
[[nodiscard]] bool is_measured_point_file(const std::filesystem::path& file);

/// Those of these names that other kinds of files have, too (.csv, .pts, .txt).
[[nodiscard]] bool has_common_point_name(const std::filesystem::path& file);

/// Lines that begin with # or // are comments, a first line of names (x, y, z, ...) tells the columns, and a
/// first line with one whole number the number of points. Columns beyond x, y and z are not read: of a file
/// that separates by commas only where its first line names them, since a comma may be a decimal point.
/// Throws Error with file and line for another kind of line, numbers that are not finite, decimal commas,
/// points that are not there or too many; Cancelled.
[[nodiscard]] MeasuredPoints read_measured_points(const std::filesystem::path& file,
                                                  const Progress& progress);

/// The same of text at hand; `file` is named in diagnostics.
[[nodiscard]] MeasuredPoints
parse_measured_points(std::string_view text, const std::filesystem::path& file, const Progress& progress);

} // namespace millwright::exchange
