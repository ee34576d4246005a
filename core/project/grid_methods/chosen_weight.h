// The weight that grids follow: as it is chosen, and as it is painted.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/vectors.h"
#include "core/grid/weight.h"
#include "core/grid/weight_mix.h"
#include "core/project/project.h"

namespace millwright::project {

/// The weight of the elliptic functional that was chosen on `patch`, where the error density of the uniform
/// grid (or of a later one) is `error`; null, if nothing is known of it, for a choice that needs it. Throws
/// Error if an expression has no sense.
[[nodiscard]] grid::WeightPtr
chosen_weight(const GridInput& input, const geometry::ParametricSurface& patch, const grid::WeightPtr& error);

/// How much of the weight counts where, in solver coordinates; null where all of it counts everywhere.
[[nodiscard]] grid::WeightPtr region_weight(const GridInput& input, const geometry::ParametricSurface& patch);

/// Whether the chosen weight comes from the measured error, if only in part.
[[nodiscard]] bool needs_error(const EllipticInput& input);

/// Paints on the weight from `from` to `to` on `patch` (a dab where both are one), on a fresh table if
/// nothing was painted so far. True if something has changed. What is painted counts where the weight is
/// mixed and its share is not 0.
bool paint_weight(EllipticInput& input,
                  const geometry::ParametricSurface& patch,
                  const Vec2& from,
                  const Vec2& to,
                  const grid::Brush& brush);

/// Makes what is painted count: mixes the weight, with what it was made of so far, where it is not mixed.
void let_paint_count(EllipticInput& input);

} // namespace millwright::project
