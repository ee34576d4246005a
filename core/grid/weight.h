// The weight w of the volume term: where it is large, cells become small (the area of a cell goes like
// w^(-1/2), since w J^2 is what the Euler equations even out). Points are in solver coordinates, where the
// spacing of a uniform grid is 1: x = u (nu - 1), y = v (nv - 1). W1 ... W5 are those of (Parasilmongkol
// 1997, KMITL), ch. 4.
#pragma once

#include "core/grid/error_model.h"
#include "core/grid/grid.h"
#include "core/grid/node_array.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace millwright::grid {

/// Const and callable from several threads.
class Weight {
public:
    virtual ~Weight() = default;

    /// w at each point. Throws Error where a weight that a person typed has no finite value.
    virtual void values(std::span<const Vec2> at, std::span<double> w) const = 0;

    /// (dw/dx, dw/dy) at each point.
    virtual void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const = 0;
};

using WeightPtr = std::shared_ptr<const Weight>;

/// The same everywhere: no adaptation.
[[nodiscard]] WeightPtr constant_weight(double value);

/// exp(-|r^2 - (x - cx)^2 - (y - cy)^2|) + 0.01, large on a circle.
struct Ring {
    Vec2 centre{10.0, 10.0};
    double radius_squared = 25.0;
};
[[nodiscard]] WeightPtr ring_weight(const Ring& ring);

/// Circle of radius 5 about (10, 10).
[[nodiscard]] WeightPtr weight_w1();
/// W1 stretched over side x side nodes: as wide there as on 25 x 25.
[[nodiscard]] WeightPtr weight_w1_on(int side);
/// Circle of radius sqrt(rows) about (10, 10).
[[nodiscard]] WeightPtr weight_w2(int rows);
/// Quarter circle of radius 5 about (rows, columns).
[[nodiscard]] WeightPtr weight_w3(int rows, int columns);
/// sin(2 pi x / 25) sin(2 pi y / 25) / 1000. Changes its sign, so the functional has no lower bound.
[[nodiscard]] WeightPtr weight_w4();
/// exp((x^2 + y^2) / scale^2). With scale 1 it is beyond the range of numbers from 27 nodes on.
[[nodiscard]] WeightPtr weight_w5(double scale);

/// w at every node, row by row. Parallel.
[[nodiscard]] std::vector<double> weight_at_nodes(const Weight& weight, const NodeArray& nodes);

/// How many nodes have a weight that is not positive. If any, the functional may have no minimum: warn.
[[nodiscard]] int count_not_positive(const Weight& weight, const NodeArray& nodes);

// The weight that a measured error gives: large where moves are wrong for their length. Per node the density
// e / h^2 (independent of the grid where the error is smooth, since e = kappa h^2), divided by its maximum,
// raised to a power, smoothed, and lifted by a floor; between the nodes on a raster of its own, with a
// continuous slope.

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
