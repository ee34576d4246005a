// A weight put together from several reasons for small cells: the error, the curvature, what a person has
// painted, a formula. Each is a field over the parameters; smoothing and a range keep the sum of them tame.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/weight.h"

#include <vector>

namespace millwright::grid {

/// Values at u = i / (rows - 1), v = j / (columns - 1), linear between them.
struct Field {
    int rows = 0;
    int columns = 0;
    std::vector<double> values; ///< [rows x columns], row = u

    /// Of one value everywhere. Throws Defect if smaller than 2 x 2.
    [[nodiscard]] static Field constant(int rows, int columns, double value);

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
    }
    [[nodiscard]] Vec2 place(int i, int j) const {
        return {static_cast<double>(i) / (rows - 1), static_cast<double>(j) / (columns - 1)};
    }
    /// At (u, v), which the square [0,1]^2 is asked for where it lies outside.
    [[nodiscard]] double at(const Vec2& uv) const;

    friend bool operator==(const Field&, const Field&) = default;
};

enum class Combination {
    sum,
    product, ///< of 1 + share * value, so that a reason that is absent somewhere does not rub out the others
    largest,
};

/// How much each reason counts, 0: not at all. What has no share need not be there.
struct MixSettings {
    double error = 1.0;
    double curvature = 0.0;
    double painted = 0.0;
    double expression = 0.0;
    Combination combination = Combination::sum;
    int smoothing_passes = 2; ///< of the 9-point average over the raster of the weight
    double low = 0.03;        ///< the weight is at least this, positive
    double high = 100.0;      ///< and at most this

    friend bool operator==(const MixSettings&, const MixSettings&) = default;
};

/// The reasons, in solver coordinates of the grid that is adapted. Null where there is none.
struct MixedReasons {
    WeightPtr error{};      ///< error density; divided by its largest value, to the power 0.7
    WeightPtr curvature{};  ///< from curvature_weight()
    WeightPtr painted{};    ///< from field_weight(), 0 to 1
    WeightPtr expression{}; ///< as it is
};

/// Positive. Throws Error if a formula has no value somewhere; Defect if a share has no reason, or the range
/// or a share no sense.
[[nodiscard]] WeightPtr
mixed_weight(const MixedReasons& reasons, const MixSettings& settings, int nu, int nv);

/// sqrt(k1^2 + k2^2) of `patch`, divided by its largest value on the nodes of the grid and halfway between
/// them, where it is 0 on a plane. Places without a normal count as the largest.
[[nodiscard]] WeightPtr curvature_weight(const geometry::ParametricSurface& patch, int nu, int nv);

/// `field` in the solver coordinates of a grid of nu x nv nodes.
[[nodiscard]] WeightPtr field_weight(const Field& field, int nu, int nv);

/// A brush on the surface, round in mm whatever the parameters are.
struct Brush {
    double radius_mm = 10.0; ///< positive
    double value = 1.0;      ///< that it paints, 0 to 1: 0 rubs out
    double strength = 1.0;   ///< share of the way to `value` in the middle, 0 to 1
    double hardness = 0.5; ///< share of the radius that gets the whole strength; beyond, it fades to the rim
};

/// One dab of `brush` on `field` about the point of `patch` at `uv`, in steps of 0.001. True if something has
/// changed.
bool dab(Field& field, const geometry::ParametricSurface& patch, const Vec2& uv, const Brush& brush);

/// Dabs from `from` to `to`, no farther apart than a quarter of the radius, without the one at `from`.
bool stroke(Field& field,
            const geometry::ParametricSurface& patch,
            const Vec2& from,
            const Vec2& to,
            const Brush& brush);

} // namespace millwright::grid
