// What is machined as one surface over the parameters (u,v) in [0,1]^2, whatever faces lie behind it: grids
// and tool paths see its surface; the exact face, what of it is covered and the way back from a point are
// asked here.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/bspline_surface.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/trim.h"
#include "core/region/region_kind.h"

#include <memory>
#include <vector>

namespace millwright::region {

/// A value: copies share what they are made of, which does not change.
class Region final : public geometry::ParametricSurface {
public:
    /// A single patch. Its numbers are those of the patch, bit for bit.
    Region(geometry::BezierPatch patch, geometry::Trim trim = {}); // NOLINT(google-explicit-constructor)
    /// A face of any number of spans, without a fit.
    Region(geometry::BsplineSurface face, geometry::Trim trim = {}); // NOLINT(google-explicit-constructor)
    /// Throws Defect for null.
    explicit Region(std::shared_ptr<const RegionKind> kind);

    [[nodiscard]] Vec3 position(double u, double v) const override { return surface_->position(u, v); }
    [[nodiscard]] geometry::SurfaceDerivatives derivatives(double u, double v) const override {
        return surface_->derivatives(u, v);
    }
    [[nodiscard]] geometry::SurfacePoint point(double u, double v) const override {
        return surface_->point(u, v);
    }
    [[nodiscard]] const Box3& control_box() const override { return surface_->control_box(); }
    [[nodiscard]] double smallest_tangent() const override { return surface_->smallest_tangent(); }
    [[nodiscard]] std::vector<geometry::SurfacePiece> pieces() const override { return surface_->pieces(); }
    [[nodiscard]] std::shared_ptr<const geometry::ParametricSurface> shared() const override;

    [[nodiscard]] int face_count() const { return kind_->face_count(); }
    [[nodiscard]] FacePlace face_behind(const Vec2& uv) const { return kind_->face_behind(uv); }
    /// Whether the place belongs to what is machined: inside the outlines and in no hole. On the border of
    /// the parameters: whether what lies next to it inside does.
    [[nodiscard]] bool covers(const Vec2& uv) const { return kind_->covers(uv); }
    /// The inverse: the place whose point is nearest to `point`, on the whole surface, covered or not. Throws
    /// Defect if the point is not finite.
    [[nodiscard]] geometry::ClosestPoint nearest(const Vec3& point) const { return kind_->nearest(point); }
    /// About z through the origin, rad, counter-clockwise seen from above.
    [[nodiscard]] Region turned(double turn) const { return Region(kind_->turned(turn)); }

private:
    std::shared_ptr<const RegionKind> kind_;
    const geometry::ParametricSurface* surface_; ///< of kind_
};

} // namespace millwright::region
