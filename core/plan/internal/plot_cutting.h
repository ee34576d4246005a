// The stages of a plot in which its strokes or its picture become a path that is cut.
#pragma once

#include "core/geometry/vectors.h"
#include "core/plan/internal/plot_stages.h"
#include "core/plot/cut_path.h"
#include "core/project/plot_input.h"

#include <memory>
#include <vector>

namespace millwright::plan {

/// Of what is cut along strokes: compensated, filled, ordered and linked, for a tool that comes from the
/// origin.
void plan_strokes(const PlotStageWork& work);

/// The path before it is moved to the origin.
void make_cut(const PlotStageWork& work);

/// Whether the place where tools are changed counts for the path.
[[nodiscard]] bool changes_tools(const project::PlotInput& input);

/// `path` where it lies on the machine, mm; null stays null.
[[nodiscard]] std::shared_ptr<const plot::CutPath> at_origin(const std::shared_ptr<const plot::CutPath>& path,
                                                             const Vec2& origin);

/// What is cut, as PlotResult::cuts: the path is there.
[[nodiscard]] std::vector<PlotResult::LevelPath> cuts_by_level(const PlotStageWork& work);

} // namespace millwright::plan
