// The point file of the table: one point per line, X, Y, Z in mm, commas between, as the KMITL thesis on the
// HPGL decoder of an XYZ table prints it (two decimals). Tables of other programs are read, too: semicolons
// or tabs between, then with decimal commas or points, and a first line that names the columns.
#pragma once

#include "core/base/error.h"
#include "core/geometry/vectors.h"
#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::plot {

/// Throws Defect if a coordinate is not finite.
[[nodiscard]] std::string point_file_text(const std::vector<Vec3>& points, int decimals = 2);

struct PointFile {
    std::vector<Vec3> points;
    std::vector<int> lines;              ///< of each point, from 1
    std::vector<Diagnostic> diagnostics; ///< a bad line each, with its number; the first 100
};

/// Reads the points; blank lines are passed over, lines that are no point are left out and reported.
[[nodiscard]] PointFile read_points(std::string_view text, const std::filesystem::path& file);

/// Whether `text`, perhaps only the beginning of a file, begins with a point on a line of its own.
[[nodiscard]] bool is_point_file(std::string_view text);

// The points of a table as what they cut: a path that is drawn, made a program of, and measured. Lengths mm,
// speeds mm/s; z = 0 is the top of the work.

struct PointPathSettings {
    double cutting = 10.0; ///< > 0; the points themselves have no speed before their period is known
    double plunging = 2.0; ///< straight down into the work, > 0
    double safe_height = 5.0;
};

/// Points that are not above the top of the work, or not above the lowest one where that is higher, are in
/// the work; between two of them it cuts. Begins and ends at the safe height or higher. Without points it is
/// empty.
[[nodiscard]] CutPath path_of_points(const std::vector<Vec3>& points, const PointPathSettings& settings = {});

/// What is cut, as strokes of pen 1.
[[nodiscard]] Strokes strokes_of_points(const std::vector<Vec3>& points);

} // namespace millwright::plot
