#include "core/region/internal/side_curve.h"

#include "core/region/face_mesh.h"

#include <algorithm>
#include <cmath>

namespace millwright::region {

namespace {

constexpr int curve_steps = 256;

double part_of(double along) {
    return std::clamp(along, 0.0, 1.0) * curve_steps;
}

} // namespace

Vec2 place_on_side(int side, double along) {
    switch (side) {
    case 0:
        return {along, 0.0};
    case 1:
        return {1.0, along};
    case 2:
        return {1.0 - along, 1.0};
    default:
        return {0.0, 1.0 - along};
    }
}

SideCurve::SideCurve(const geometry::BsplineSurface& face, int side, double inset)
    : face_(&face), side_(side), inset_(inset) {
    double length = 0.0;
    for (int n = 0; n <= curve_steps; ++n) {
        samples_.push_back(position(static_cast<double>(n) / curve_steps));
        if (n > 0) {
            length += (samples_.back() - samples_[static_cast<std::size_t>(n) - 1]).norm();
        }
        lengths_.push_back(length);
        box_.extend(samples_.back());
    }
}

Vec2 SideCurve::place(double along) const {
    Vec2 uv = place_on_side(side_, along);
    uv[1 - side_ % 2] += side_ == 0 || side_ == 3 ? inset_ : -inset_;
    return uv;
}

Vec3 SideCurve::position(double along) const {
    const Vec2 uv = place(along);
    return face_->position(uv.x(), uv.y());
}

double SideCurve::length_at(double along) const {
    const double part = part_of(along);
    const auto n = static_cast<std::size_t>(std::min(static_cast<int>(part), curve_steps - 1));
    return lengths_[n] + (part - static_cast<double>(n)) * (lengths_[n + 1] - lengths_[n]);
}

double SideCurve::along_at(double length) const {
    const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, length);
    const auto n = static_cast<double>(above - lengths_.begin() - 1);
    const double low = *(above - 1), high = *above;
    const double share = high > low ? std::clamp((length - low) / (high - low), 0.0, 1.0) : 0.0;
    return (n + share) / curve_steps;
}

SideCurve::Foot SideCurve::nearest(const Vec3& point, double from, double to) const {
    const auto off = [&](double along) { return (position(along) - point).squaredNorm(); };
    double best = off(from) <= off(to) ? from : to;
    double least = off(best);
    for (int n = static_cast<int>(std::ceil(part_of(from))); n <= static_cast<int>(part_of(to)); ++n) {
        const double squared = (samples_[static_cast<std::size_t>(n)] - point).squaredNorm();
        if (squared < least) {
            least = squared;
            best = static_cast<double>(n) / curve_steps;
        }
    }
    // Between the neighbours of the nearest sample the distance has one minimum: halved by its slope.
    double low = std::max(from, best - 1.0 / curve_steps), high = std::min(to, best + 1.0 / curve_steps);
    const auto falls = [&](double along) {
        const Vec2 uv = place(along);
        const geometry::SurfaceDerivatives at = face_->derivatives(uv.x(), uv.y());
        const Vec3& tangent = side_ % 2 == 0 ? at.du : at.dv;
        return (at.position - point).dot(side_ < 2 ? tangent : Vec3(-tangent)) < 0.0;
    };
    constexpr int halvings = 45; // down to 1e-16 of the side
    for (int n = 0; n < halvings; ++n) {
        const double middle = 0.5 * (low + high);
        (falls(middle) ? low : high) = middle;
    }
    const double inside = 0.5 * (low + high);
    const double along = off(inside) < least ? inside : best;
    return {along, std::sqrt(std::min(off(inside), least))};
}

} // namespace millwright::region
