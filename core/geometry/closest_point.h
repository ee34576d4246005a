// The point of a surface that lies nearest to a given point: what "the error" means on a finished part.
#pragma once

#include "core/geometry/parametric_surface.h"

#include <memory>

namespace millwright::geometry {

struct ClosestPoint {
    Vec2 parameters = Vec2::Zero(); ///< (u, v) inside [0,1]^2
    Vec3 position = Vec3::Zero();
    double distance = 0.0; ///< mm
};

/// Descends from `start` to the local minimum of the distance, staying inside [0,1]^2.
[[nodiscard]] ClosestPoint
closest_point_near(const ParametricSurface& surface, const Vec3& point, const Vec2& start);

/// Finds global minima: descends from the nearest of a raster of samples, or from a guess of the caller, and
/// then from within each of 32 x 32 cells of the parameters whose box, by the convex hull of its control
/// points, is nearer than what was found. Only a cell that has several minima itself may hide one. Where the
/// weights of a single patch differ by more than a hundred times the cells are parts of the same extent
/// instead. Const after construction; may be asked from several threads. Holds its own copy of the surface.
class ClosestPointSearch {
public:
    explicit ClosestPointSearch(const ParametricSurface& surface);
    ~ClosestPointSearch();
    ClosestPointSearch(ClosestPointSearch&&) noexcept;
    ClosestPointSearch& operator=(ClosestPointSearch&&) noexcept;

    [[nodiscard]] ClosestPoint closest(const Vec3& point) const;
    /// The better of the descents from `guess` and from the nearest sample, where the first does not end
    /// beside that sample anyway.
    [[nodiscard]] ClosestPoint closest(const Vec3& point, const Vec2& guess) const;

private:
    struct Samples;
    std::unique_ptr<const Samples> samples_;
};

} // namespace millwright::geometry
