#include "core/plot/carving/internal/bisector.h"

#include <algorithm>
#include <cmath>

namespace millwright::plot::internal {
namespace {

constexpr double flat_height = 1e-3; ///< of a parabola that is as good as straight, in whole units

/// Half of what a chord of a convex curve may miss in the middle, so that it misses no more anywhere.
void sample_between(const Bisector& curve,
                    double t,
                    const Vec3& from,
                    double u,
                    const Vec3& to,
                    double tolerance,
                    int depth,
                    std::vector<Vec3>& found) {
    constexpr int most_halvings = 20;
    const double middle = 0.5 * (t + u);
    const Vec3 at = curve.at(middle);
    const Vec3 missed = at - 0.5 * (from + to);
    const double off = std::max(missed.head<2>().norm(), std::abs(missed.z()));
    if (off > 0.5 * tolerance && depth < most_halvings) {
        sample_between(curve, t, from, middle, at, tolerance, depth + 1, found);
        sample_between(curve, middle, at, u, to, tolerance, depth + 1, found);
        return;
    }
    found.push_back(to);
}

} // namespace

double clearance(const Site& site, const Vec2& place) {
    if (site.point) {
        return (place - site.a).norm();
    }
    const Vec2 along = site.b - site.a;
    return std::abs(cross(along, place - site.a)) / along.norm();
}

Bisector::Bisector(const Site& one, const Site& other, const Vec2& from, const Vec2& to)
    : site_(one.point ? one : other), from_(from), to_(to) {
    if (one.point == other.point) {
        return;
    }
    const Site& line = one.point ? other : one;
    along_ = (line.b - line.a).normalized();
    const Vec2 to_point = site_.a - line.a;
    height_ = std::abs(cross(along_, to_point));
    foot_ = line.a + along_.dot(to_point) * along_;
    if (height_ > flat_height) {
        parabola_ = true;
        across_ = (site_.a - foot_) / height_;
    }
}

Vec3 Bisector::at(double t) const {
    const Vec2 straight = (1.0 - t) * from_ + t * to_;
    if (!parabola_) {
        return {straight.x(), straight.y(), clearance(site_, straight)};
    }
    const double u = along_.dot(straight - foot_);
    const double y = (u * u + height_ * height_) / (2.0 * height_);
    const Vec2 place = foot_ + u * along_ + y * across_;
    return {place.x(), place.y(), y};
}

std::vector<Vec3> Bisector::sampled(double tolerance) const {
    const auto end = [&](const Vec2& place) { return Vec3(place.x(), place.y(), clearance(site_, place)); };
    std::vector<Vec3> found{end(from_)};
    sample_between(*this, 0.0, found.front(), 1.0, end(to_), tolerance, 0, found);
    return found;
}

} // namespace millwright::plot::internal
