// A region that is one face: a Bezier patch or a B-spline, whose parameters are the region's.
#pragma once

#include "core/geometry/closest_point.h"
#include "core/geometry/net_editing.h"
#include "core/geometry/trim.h"
#include "core/region/region_kind.h"

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace millwright::region {

template <class Face> class FaceRegion final : public RegionKind {
public:
    FaceRegion(Face face, geometry::Trim trim) : face_(std::move(face)), trim_(std::move(trim)) {}

    [[nodiscard]] const geometry::ParametricSurface& surface() const override { return face_; }
    [[nodiscard]] int face_count() const override { return 1; }
    [[nodiscard]] FacePlace face_behind(const Vec2& uv) const override { return {0, uv}; }
    [[nodiscard]] bool covers(const Vec2& uv) const override {
        const bool in_square = (uv.array() >= 0.0).all() && (uv.array() <= 1.0).all();
        return in_square && (trim_.everything() || trim_.contains(uv));
    }
    [[nodiscard]] geometry::ClosestPoint nearest(const Vec3& point) const override {
        std::call_once(searched_, [&] { search_.emplace(face_); });
        return search_->closest(point);
    }
    [[nodiscard]] std::shared_ptr<const RegionKind> turned(double turn) const override {
        return std::make_shared<const FaceRegion>(Face(geometry::turned(face_.net(), turn)), trim_);
    }

private:
    Face face_;
    geometry::Trim trim_;
    mutable std::once_flag searched_; // few ask for it, and it takes some time to make
    mutable std::optional<geometry::ClosestPointSearch> search_;
};

} // namespace millwright::region
