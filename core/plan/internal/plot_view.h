// A cutting path as it is drawn: what is cut, and how the tool travels.
#pragma once

#include "core/gcode/preview_path.h"
#include "core/geometry/vectors.h"
#include "core/plan/plot_work.h"
#include "core/plot/cut_path.h"

#include <vector>

namespace millwright::plan {

/// The moves in the work, nothing between them, `shift` across.
[[nodiscard]] gcode::PreviewPath cuts_of(const plot::CutPath& path, const Vec2& shift);

/// Those of one tool.
[[nodiscard]] gcode::PreviewPath cuts_with(const plot::CutPath& path, int tool);

/// The moves in the work by their mean depths, from the top, `shift` across.
[[nodiscard]] std::vector<PlotResult::LevelPath> cuts_by_depth(const plot::CutPath& path, const Vec2& shift);

/// The moves in the air.
[[nodiscard]] gcode::PreviewPath travel_of(const plot::CutPath& path);

} // namespace millwright::plan
