// A region of several faces.
#pragma once

#include "core/geometry/closest_point.h"
#include "core/region/internal/joined_surface.h"
#include "core/region/region_kind.h"

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace millwright::region {

class JoinedFaces final : public RegionKind {
public:
    explicit JoinedFaces(JoinedSurface surface) : surface_(std::move(surface)) {}

    [[nodiscard]] const geometry::ParametricSurface& surface() const override { return surface_; }
    [[nodiscard]] int face_count() const override { return static_cast<int>(surface_.faces().size()); }
    [[nodiscard]] FacePlace face_behind(const Vec2& uv) const override {
        const OnFace on = surface_.on_face(uv);
        return {on.face, on.uv.cwiseMax(0.0).cwiseMin(1.0)};
    }
    /// The faces fill the square.
    [[nodiscard]] bool covers(const Vec2& uv) const override {
        return (uv.array() >= 0.0).all() && (uv.array() <= 1.0).all();
    }
    [[nodiscard]] geometry::ClosestPoint nearest(const Vec3& point) const override {
        std::call_once(searched_, [&] { search_.emplace(surface_); });
        return search_->closest(point);
    }
    [[nodiscard]] std::shared_ptr<const RegionKind> turned(double turn) const override {
        return std::make_shared<const JoinedFaces>(surface_.turned(turn));
    }

private:
    JoinedSurface surface_;
    mutable std::once_flag searched_; // few ask for it, and it takes some time to make
    mutable std::optional<geometry::ClosestPointSearch> search_;
};

} // namespace millwright::region
