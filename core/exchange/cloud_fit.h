// A fair Bezier patch near scattered points, which no triangles join.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/patch_fit.h"

#include <optional>
#include <vector>

namespace millwright::exchange {

/// Degrees for which there are points enough: 5, or less where a net of that many control points would have
/// more of them than there are points.
[[nodiscard]] int cloud_degree(std::size_t points);

/// The patch fills the least rectangle around the points as seen from `FitSettings::along` (if not given,
/// across the plane that is nearest to them, upwards). Least squares of the distances and of the second
/// differences of the net, which stand for the energy of a thin plate. The weight of the latter is the
/// smallest, by powers of ten, that leaves the control points within the box of the points enlarged by a
/// tenth of its diagonal, and lets nothing fold. Of more points than `FitSettings::points` so many are
/// fitted, spread evenly over the file; the deviation is that of all. `MeshFit::side` has the points and no
/// triangles; deviations of the patch from the points are 0. Throws Error for too few points, points in a
/// line, and where no weight does; Cancelled.
[[nodiscard]] MeshFit
fit_cloud(const std::vector<Vec3>& points, const FitSettings& settings, const Progress& progress);

/// Whether a net stays so near to the points that its patch was fitted to. `room`: share of the diagonal of
/// their box.
[[nodiscard]] bool
stays_near(const geometry::BezierPatch& patch, const std::vector<Vec3>& points, double room);

} // namespace millwright::exchange
