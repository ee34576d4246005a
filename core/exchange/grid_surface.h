// The B-spline surface through points in rows, as Bezier patches. Source: Piegl and Tiller, The NURBS Book,
// 2nd ed., ch. 9.2.5, algorithms A9.3 and A9.4; the patches by blossoms (Ramshaw 1989).
#pragma once

#include "core/base/progress.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/point_rows.h"

#include <optional>
#include <vector>

namespace millwright::exchange {

/// Along a row or across the rows.
inline constexpr int most_interpolated_points = 1'000;
/// So many points along a direction make one span, of the degree one below their number; more make a C2 curve
/// of cubic spans.
inline constexpr int most_points_of_one_span = 6;

struct GridSurface {
    PointGrid grid; ///< the points, each row turned round where `along` asks for it
    /// Not trimmed; one patch where neither direction has more points than one span, else with `bspline`.
    CadFace face;
    std::vector<Vec2> places; ///< of the points on the face, in [0, rows] x [0, columns]; row by row
};

/// Through every point, up to rounding. Parameters are shares of the chord length, averaged over the rows;
/// knots are averages of them. Distances are in the unit of the points. `along`: unit, the side that S_u x
/// S_v looks to; by default the one of +z, of an upright surface +y, then +x. Throws Error where a direction
/// has more than `most_interpolated_points`, for more than `most_cad_patches`, and where neighbours of every
/// row or column are in one place; Cancelled.
[[nodiscard]] GridSurface
surface_through(PointGrid grid, const std::optional<Vec3>& along, const Progress& progress);

} // namespace millwright::exchange
