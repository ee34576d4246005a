#include "ui/viewport/point_drag.h"

#include "core/base/error.h"
#include "ui/render/convert.h"
#include "ui/viewport/internal/boxes.h"

#include <cmath>
#include <utility>

namespace millwright::viewport {

namespace {

constexpr double snap_px = 8.0;
constexpr double still = 1e-6; // of a step; what a coordinate moves less is rounding
constexpr double grazing =
    1e-3; // sine of the angle between an axis and the line of sight; below, it runs away

/// The point of the axis through `origin` along unit `axis` that is nearest to the ray.
std::optional<Vec3>
nearest_on_axis(const Vec3& origin, const Vec3& axis, const Vec3& eye, const Vec3& direction) {
    const double along = axis.dot(direction);
    const double sine_squared = 1.0 - along * along;
    if (sine_squared < grazing * grazing) {
        return std::nullopt;
    }
    const Vec3 between = eye - origin;
    const double at = (between.dot(axis) - along * between.dot(direction)) / sine_squared;
    return origin + at * axis;
}

double rounded(double value, double step) {
    return step * std::round(value / step);
}

} // namespace

double snap_step(const render::View& view, const Vec3& point_s) {
    return round_length(snap_px * view.content_scale * render::pixel_length(view, render::to_glm(point_s)));
}

PointDrag::PointDrag(std::vector<MovedControlPoint> points,
                     std::size_t grabbed,
                     const Frame& s_T_w,
                     const glm::dvec2& pixel,
                     std::vector<Vec3> shares)
    : start_(std::move(points)), shares_(std::move(shares)), grabbed_(grabbed), s_T_w_(s_T_w),
      start_pixel_(pixel), last_pixel_(pixel) {
    if (shares_.empty()) {
        shares_.assign(start_.size(), Vec3::Ones());
    }
    expects(grabbed_ < start_.size() && shares_.size() == start_.size(),
            "the grabbed control point is one of those dragged, and all have their shares");
}

std::optional<Vec3> PointDrag::place(const render::View& view, const glm::dvec2& pixel) const {
    const render::Ray sight = render::ray(view, pixel);
    const Frame w_T_s = s_T_w_.inverse();
    const Vec3 origin = grabbed().position;
    if (axis_) {
        const Vec3 eye = w_T_s * render::to_core(sight.origin);
        const Vec3 direction = w_T_s.linear() * render::to_core(sight.direction);
        return nearest_on_axis(origin, Vec3::Unit(*axis_), eye, direction);
    }
    const auto met = render::meet_plane(sight, render::to_glm(s_T_w_ * origin), render::looking_along(view));
    return met ? std::optional<Vec3>(w_T_s * render::to_core(*met)) : std::nullopt;
}

void PointDrag::move_to(const render::View& view, const glm::dvec2& pixel, const DragKeys& keys) {
    if (keys.axis != axis_) {
        axis_ = keys.axis;
        last_pixel_ = start_pixel_;
        way_ = Vec3::Zero();
    }
    const std::optional<Vec3> from = place(view, last_pixel_);
    const std::optional<Vec3> to = place(view, pixel);
    if (from && to) {
        way_ += (keys.fine ? fine_factor : 1.0) * (*to - *from);
        last_pixel_ = pixel;
    }
    moved_ = (keys.snap ? snapped(view) : way_).cwiseProduct(shares_[grabbed_].cwiseAbs());
}

Vec3 PointDrag::snapped(const render::View& view) const {
    const Vec3 origin = grabbed().position;
    const double step = snap_step(view, s_T_w_ * origin);
    Vec3 moved = way_;
    for (int k = 0; k < 3; ++k) {
        const bool moves = axis_ ? k == *axis_ : std::abs(way_[k]) > still * step;
        if (moves) {
            moved[k] = rounded(origin[k] + way_[k], step) - origin[k];
        }
    }
    return moved;
}

std::vector<MovedControlPoint> PointDrag::points() const {
    std::vector<MovedControlPoint> points = start_;
    for (std::size_t n = 0; n < points.size(); ++n) {
        points[n].position += shares_[n].cwiseProduct(moved_);
    }
    return points;
}

} // namespace millwright::viewport
