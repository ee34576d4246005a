#include "core/mesh_finish/cutter_outline.h"

#include "core/base/numbers.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>

namespace millwright::mesh_finish {

namespace {

/// Edges that are shorter seen along the axis are upright: their upper end counts, mm.
constexpr double upright = 1e-12;

/// Planes that rise more steeply are upright: their edges alone stop a cutter, which is off by less than the
/// width of such a facet seen along the axis, a nanometre for a millimetre of height.
constexpr double steepest = 1e6;

} // namespace

CutterOutline::CutterOutline(const toolpath::Profile& body) {
    const toolpath::ProfileShape& shape = body.shape();
    flat_ = shape.flat;
    corner_ = shape.corner;
    radius_ = shape.radius;
    bottom_ = shape.bottom;
    const double s = std::sin(shape.half_angle);
    const double c = std::cos(shape.half_angle);
    flank_from_ = std::min(flat_ + corner_ * c, radius_);
    flank_height_ = bottom_ + corner_ * (1.0 - s);
    flank_slope_ = s > 0.0 ? c / s : infinity;
    largest_corner_angle_ = 0.5 * pi - shape.half_angle;
}

CutterOutline CutterOutline::grown(double by) const {
    CutterOutline more = *this;
    more.corner_ += by;
    more.radius_ += by;
    more.bottom_ -= by;
    const double s = std::cos(largest_corner_angle_);
    const double c = std::sin(largest_corner_angle_);
    more.flank_from_ = std::min(flat_ + more.corner_ * c, more.radius_);
    more.flank_height_ = more.bottom_ + more.corner_ * (1.0 - s);
    return more;
}

double CutterOutline::height(double rho) const {
    const bool sharp_rim = !(corner_ > 0.0) && !(flank_slope_ < infinity);
    if (rho <= flat_ || sharp_rim) {
        return bottom_;
    }
    if (rho > flank_from_ && flank_slope_ < infinity) {
        return flank_height_ + (rho - flank_from_) * flank_slope_;
    }
    const double out = std::min(rho - flat_, corner_);
    return bottom_ +
           out * out / (corner_ + std::sqrt(corner_ * corner_ - out * out)); // r - sqrt(r^2 - out^2)
}

double CutterOutline::slope(double rho) const {
    if (rho < flat_) {
        return 0.0;
    }
    if (rho >= flank_from_) {
        return flank_slope_;
    }
    const double out = rho - flat_;
    return out / std::sqrt(std::max(corner_ * corner_ - out * out, 0.0));
}

std::optional<Rest> CutterOutline::on_point(const Vec2& at, const Vec3& point) const {
    const double rho = (point.head<2>() - at).norm();
    if (!(rho <= radius_)) {
        return std::nullopt;
    }
    return Rest{point.z() - height(rho), point};
}

double CutterOutline::along_corner(double off, double slope) const {
    // sin(phi) s - slope rho cos(phi) = 0 for rho = f + r sin(phi), s^2 = rho^2 - off^2: Newton between
    // bounds.
    const double r = corner_;
    double low = off > flat_ ? std::asin(std::clamp((off - flat_) / r, 0.0, 1.0)) : 0.0;
    double high = largest_corner_angle_;
    double phi = std::clamp(std::atan(slope), low, high);
    constexpr int most_steps = 100;
    constexpr double exact = 1e-12; // rad: the height is flat there, its error is the square
    const auto reach = [&](double rho) { return std::sqrt(std::max(rho * rho - off * off, 0.0)); };
    for (int n = 0; n < most_steps && high - low > exact; ++n) {
        const double rho = flat_ + r * std::sin(phi);
        const double s = reach(rho);
        const double value = std::sin(phi) * s - slope * rho * std::cos(phi);
        (value < 0.0 ? low : high) = phi;
        const double widens = r * std::cos(phi);
        const double grows = std::cos(phi) * s + (s > 0.0 ? std::sin(phi) * rho * widens / s : 0.0) -
                             slope * widens * std::cos(phi) + slope * rho * std::sin(phi);
        double next = phi - value / grows;
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        if (std::abs(next - phi) <= exact) {
            phi = next;
            break;
        }
        phi = next;
    }
    return reach(flat_ + r * std::sin(phi));
}

double CutterOutline::along_edge(double off, double slope) const {
    const double rim = std::sqrt(std::max(radius_ * radius_ - off * off, 0.0));
    if (!(slope > 0.0)) {
        return 0.0;
    }
    const bool upright_flank = !(flank_slope_ < infinity);
    if (upright_flank && !(corner_ > 0.0)) {
        return rim;
    }
    if (upright_flank && !(flat_ > 0.0)) { // a ball: its section is a circle
        return rim * slope / std::hypot(1.0, slope);
    }
    const double begins = std::sqrt(std::max(flank_from_ * flank_from_ - off * off, 0.0));
    if (corner_ > 0.0 && off < flank_from_) {
        // On the corner unless the edge still rises faster than the cutter where the corner ends.
        const bool beyond = !upright_flank && flank_slope_ * begins < slope * flank_from_;
        if (!beyond) {
            return along_corner(off, slope);
        }
    }
    if (!(flank_slope_ > slope)) {
        return rim;
    }
    const double tangent = slope * off / std::sqrt(flank_slope_ * flank_slope_ - slope * slope);
    return std::clamp(tangent, begins, rim);
}

std::optional<Rest> CutterOutline::on_edge(const Vec2& at, const Vec3& a, const Vec3& b) const {
    const Vec2 span = b.head<2>() - a.head<2>();
    const double length = span.norm();
    if (!(length > upright)) {
        return on_point(at, a.z() > b.z() ? a : b);
    }
    const Vec2 along = span / length;
    const Vec2 from_axis = a.head<2>() - at;
    const double begin = from_axis.dot(along);
    const double off = std::abs(cross(along, from_axis));
    if (!(off <= radius_)) {
        return std::nullopt;
    }
    const double rim = std::sqrt(std::max(radius_ * radius_ - off * off, 0.0));
    const double low = std::max(begin, -rim);
    const double high = std::min(begin + length, rim);
    if (!(low <= high)) {
        return std::nullopt;
    }
    const double rise = (b.z() - a.z()) / length;
    const double best = std::copysign(along_edge(off, std::abs(rise)), rise);
    const double s = std::clamp(best, low, high); // the height over an edge has one top
    const double t = std::clamp((s - begin) / length, 0.0, 1.0);
    const Vec3 contact = a + t * (b - a);
    return Rest{contact.z() - height(std::min(std::hypot(off, s), radius_)), contact};
}

std::optional<Rest> CutterOutline::on_plane(const Vec2& at, const Vec3& point, const Vec3& normal) const {
    const double up = std::abs(normal.z());
    const double aside = normal.head<2>().norm();
    if (!(steepest * up > aside)) {
        return std::nullopt;
    }
    const Vec2 gradient = -normal.head<2>() / normal.z();
    const double steep = aside / up;
    const double rho = steep > flank_slope_ ? radius_
                       : corner_ > 0.0      ? flat_ + corner_ * steep / std::hypot(1.0, steep)
                                            : flat_;
    const double level = point.z() + gradient.dot(at - point.head<2>());
    if (!(steep > 0.0)) {
        return Rest{level - bottom_, Vec3(at.x(), at.y(), level)};
    }
    const Vec2 foot = at + rho * gradient / steep;
    const double z = level + rho * steep;
    return Rest{z - height(rho), Vec3(foot.x(), foot.y(), z)};
}

} // namespace millwright::mesh_finish
