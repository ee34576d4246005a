// `millwright plot` of a point file: what a table plays, looked at and cut as a path.
#pragma once

#include "app/plots/stroke_cutting.h"
#include "core/plot/stroke_svg.h"

#include <filesystem>
#include <string>

namespace millwright::app {

/// Whether `file` begins with a point: three numbers with commas between. Pipes never do.
[[nodiscard]] bool is_point_file(const std::filesystem::path& file);

/// Each throws Error with the first line that is no point, after it has named the others on standard error.
int points_info(const std::string& file, bool json);
int points_view(const std::string& file, plot::AirInSvg air, const std::string& out);
int points_toolpath(const std::string& file, const StrokeCutting& cutting);

} // namespace millwright::app
