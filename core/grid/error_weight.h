// The weight that a measured error gives: large where moves are wrong for their length. Per node the density
// e / h^2 (independent of the grid where the error is smooth, since e = kappa h^2), divided by its maximum,
// raised to a power, smoothed, and lifted by a floor; between the nodes on a raster of its own, with a
// continuous slope.
#pragma once

#include "core/grid/error_model.h"
#include "core/grid/grid.h"
#include "core/grid/weight.h"

#include <cstddef>
#include <span>
#include <vector>

namespace millwright::grid {

/// Errors of moves below this are rounding, mm: 1000 ulp at 1 m.
inline constexpr double no_error = 1e-10;

/// The defaults are what cut the error most on a dome and a two-bell surface on two machines
/// (tests/core/toolpath/elliptic_gain_test.cpp).
struct ErrorWeightSettings {
    double exponent = 0.7;    ///< p
    double floor = 0.03;      ///< eps: what is added, so that no weight is zero
    int smoothing_passes = 2; ///< of the 9-point average

    friend bool operator==(const ErrorWeightSettings&, const ErrorWeightSettings&) = default;
};

/// e / h^2 at each node, row by row: the larger of its track's two moves there; h is the length of a move in
/// solver coordinates. Moves out of reach count as the worst of the others. `moves` as from measure().
[[nodiscard]] std::vector<double>
error_density(const Grid& grid, TrackDirection direction, std::span<const MoveError> moves);

/// eps + smoothed (density / max)^p at each node; 1 everywhere if there is no error at all.
[[nodiscard]] std::vector<double>
scaled_weight(std::vector<double> density, int rows, int columns, const ErrorWeightSettings& settings);

/// Once the mean of each node and its neighbours (up to 9).
[[nodiscard]] std::vector<double>
nine_point_average(const std::vector<double>& values, int rows, int columns);

/// The weight in solver coordinates that has (about) `w` at the nodes of `grid`, [nu x nv]; positive if `w`
/// is.
[[nodiscard]] WeightPtr weight_on(const Grid& grid, std::span<const double> w);

/// What a weight_on() a grid of rows x columns nodes takes, bytes.
[[nodiscard]] std::size_t raster_bytes(int rows, int columns);

/// (u, v) as solver coordinates and back; 0 and 1 are exact.
[[nodiscard]] NodeArray to_solver_coordinates(const NodeArray& parameters);
[[nodiscard]] NodeArray to_parameters(const NodeArray& in_solver_coordinates);

} // namespace millwright::grid
