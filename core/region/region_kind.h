// What a kind of region has to know: one file for each kind, and one constructor of Region.
#pragma once

#include "core/geometry/closest_point.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/vectors.h"

#include <memory>

namespace millwright::region {

/// The exact face behind a place of a region, and the parameters of that face there, in [0,1]^2.
struct FacePlace {
    int face = 0; ///< among the faces of the region, from 0
    Vec2 parameters = Vec2::Zero();

    friend bool operator==(const FacePlace&, const FacePlace&) = default;
};

/// Immutable; may be asked from several threads.
class RegionKind {
public:
    virtual ~RegionKind() = default;

    [[nodiscard]] virtual const geometry::ParametricSurface& surface() const = 0;
    [[nodiscard]] virtual int face_count() const = 0;
    [[nodiscard]] virtual FacePlace face_behind(const Vec2& uv) const = 0;
    /// Whether the place belongs to what is machined: inside the outlines and in no hole.
    [[nodiscard]] virtual bool covers(const Vec2& uv) const = 0;
    /// Of the whole surface, with what its outlines cut off.
    [[nodiscard]] virtual geometry::ClosestPoint nearest(const Vec3& point) const = 0;
    /// About z through the origin, rad, counter-clockwise seen from above.
    [[nodiscard]] virtual std::shared_ptr<const RegionKind> turned(double turn) const = 0;

protected:
    RegionKind() = default;
    RegionKind(const RegionKind&) = default;
    RegionKind& operator=(const RegionKind&) = default;
};

} // namespace millwright::region
