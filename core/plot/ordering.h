// The order and direction of strokes that keeps the tool in the air for the shortest way.
#pragma once

#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

namespace millwright::plot {

/// The same strokes with little air travel from `start` to `end`, some reversed, closed ones begun at another
/// of their points: nearest neighbours first, then 2-opt among the near ones. Pens keep their order (in which
/// they first draw), with all strokes of a pen together. Never more air travel than the order given: where
/// that is not beaten, it is what comes back. Deterministic. Throws Cancelled through `progress`.
[[nodiscard]] Strokes ordered(const Strokes& strokes,
                              const Vec2& start = Vec2::Zero(),
                              const Vec2& end = Vec2::Zero(),
                              const Progress& progress = Progress());

/// The same for strokes that are cut level by level: pens in the order in which they are first cut, what no
/// level cuts behind them. Compared with the order given is the travel of all levels and their passes, ways
/// to the change of tools as well, with the way to `end` and without.
[[nodiscard]] Strokes ordered(const Strokes& strokes,
                              const CutSettings& cut,
                              const Vec2& start = Vec2::Zero(),
                              const Vec2& end = Vec2::Zero(),
                              const Progress& progress = Progress());

} // namespace millwright::plot
