// Several faces as one surface over the unit square. A smooth map says where a place of the square is about;
// the point is that of the exact faces closest to it.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/region/internal/place_lookup.h"
#include "core/region/region_kind.h"

#include <memory>
#include <optional>
#include <vector>

namespace millwright::region {

/// Beside a face, across one of its sides: the next one, where they run along the same border.
class FaceNeighbours {
public:
    FaceNeighbours(std::size_t faces, const FaceMesh& mesh);
    /// Nothing where the side is a part of the boundary there.
    [[nodiscard]] std::optional<OnFace> across(int face, int side, double along) const;

private:
    struct Link {
        std::vector<double> along; ///< rising
        int face = 0, side = 0;
        std::vector<double> there; ///< along the other side
    };
    std::vector<std::vector<Link>> links_; ///< per face and side
};

class JoinedSurface final : public geometry::ParametricSurface {
public:
    JoinedSurface(std::vector<geometry::BsplineSurface> faces,
                  geometry::BsplineSurface map,
                  std::shared_ptr<const PlaceLookup> lookup,
                  std::shared_ptr<const FaceNeighbours> neighbours);

    [[nodiscard]] Vec3 position(double u, double v) const override { return derivatives(u, v).position; }
    [[nodiscard]] geometry::SurfaceDerivatives derivatives(double u, double v) const override;
    [[nodiscard]] geometry::SurfacePoint point(double u, double v) const override;
    [[nodiscard]] const Box3& control_box() const override { return box_; }
    [[nodiscard]] double smallest_tangent() const override { return smallest_tangent_; }
    [[nodiscard]] std::vector<geometry::SurfacePiece> pieces() const override;
    [[nodiscard]] std::shared_ptr<const geometry::ParametricSurface> shared() const override;

    /// The exact face there. Beside the boundary its parameters may lie a little beyond [0,1].
    [[nodiscard]] OnFace on_face(const Vec2& place) const;
    /// Of a place on the border of the square: how far the surface is from the boundary of the faces there,
    /// beyond it or short of it, mm. Nothing where the face there has no part in that.
    [[nodiscard]] std::optional<double> off_boundary(const Vec2& place) const;
    [[nodiscard]] const std::vector<geometry::BsplineSurface>& faces() const { return faces_; }
    /// About z through the origin, rad, counter-clockwise seen from above.
    [[nodiscard]] JoinedSurface turned(double turn) const;

private:
    struct Foot;
    [[nodiscard]] Foot foot_on(int face, Vec2 uv, const Vec3& point) const;
    [[nodiscard]] Foot foot(const Vec2& place, const Vec3& point) const;

    std::vector<geometry::BsplineSurface> faces_;
    geometry::BsplineSurface map_;
    std::shared_ptr<const PlaceLookup> lookup_;
    std::shared_ptr<const FaceNeighbours> neighbours_;
    Box3 box_;
    double smallest_tangent_ = 0.0;
};

} // namespace millwright::region
