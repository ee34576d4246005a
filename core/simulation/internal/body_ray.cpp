#include "core/simulation/internal/body_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::simulation {

namespace {

using Part = BodyCrossing::Part;
constexpr double parallel = 1e-14; // squared sine below which a line runs along the tool axis, or across it

void join(const BodyCrossing& part, std::optional<BodyCrossing>& found) {
    if (!found) {
        found = part;
        return;
    }
    if (part.enter < found->enter) {
        found->enter = part.enter;
        found->enter_part = part.enter_part;
    }
    if (part.leave > found->leave) {
        found->leave = part.leave;
        found->leave_part = part.leave_part;
    }
}

void raise_enter(BodyCrossing& part, double at, Part by) {
    if (at > part.enter) {
        part.enter = at;
        part.enter_part = by;
    }
}

void lower_leave(BodyCrossing& part, double at, Part by) {
    if (at < part.leave) {
        part.leave = at;
        part.leave_part = by;
    }
}

BodyCrossing everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// Clips to where a t^2 + 2 b t + c <= 0 for a > 0.
bool clip_to_quadric(double a, double b, double c, Part by, BodyCrossing& part) {
    const double square = b * b - a * c;
    if (square < 0.0) {
        return false;
    }
    const double root = std::sqrt(square);
    raise_enter(part, (-b - root) / a, by);
    lower_leave(part, (-b + root) / a, by);
    return part.enter < part.leave;
}

} // namespace

/// rho^2(t) = a t^2 + 2 b t + c and z(t) = height + rise t, with t counted from `origin`.
struct BodyRay::Line {
    double a, b, c, height, rise, origin;

    [[nodiscard]] double z(double t) const { return height + rise * t; }
    [[nodiscard]] double rho_squared(double t) const { return std::max((a * t + 2.0 * b) * t + c, 0.0); }

    /// Clips to low <= z <= high.
    [[nodiscard]] bool clip_to_slab(double low, double high, BodyCrossing& part) const {
        if (rise * rise < parallel) {
            return height >= low && height <= high && part.enter < part.leave;
        }
        const double at_low = (low - height) / rise;
        const double at_high = (high - height) / rise;
        if (rise > 0.0) {
            raise_enter(part, at_low, Part::bottom);
            lower_leave(part, at_high, Part::top);
        } else {
            raise_enter(part, at_high, Part::top);
            lower_leave(part, at_low, Part::bottom);
        }
        return part.enter < part.leave;
    }
    /// Clips to rho <= radius.
    [[nodiscard]] bool clip_to_cylinder(double radius, Part by, BodyCrossing& part) const {
        if (a < parallel) {
            return c <= radius * radius;
        }
        return clip_to_quadric(a, b, c - radius * radius, by, part);
    }
};

BodyRay::BodyRay(const toolpath::ProfileShape& shape) : zones_{.shape = shape} {
    const double sine = std::sin(shape.half_angle);
    const double cosine = std::cos(shape.half_angle);
    zones_.tangent = sine / cosine;
    zones_.center = shape.bottom + shape.corner;
    zones_.corner_end = zones_.center - shape.corner * sine;
    zones_.corner_radius = shape.flat + shape.corner * cosine;
    const double widens = std::max(shape.radius - zones_.corner_radius, 0.0);
    zones_.flank_end = zones_.tangent > 0.0 ? zones_.corner_end + widens / zones_.tangent : zones_.corner_end;
}

BodyRay BodyRay::grown(double distance) const {
    toolpath::ProfileShape shape = zones_.shape;
    shape.corner += distance;
    shape.radius += distance;
    shape.bottom -= distance;
    shape.top += distance;
    return BodyRay(shape);
}

std::optional<BodyCrossing>
BodyRay::crossing(const Vec3& tip, const Vec3& axis, const Vec3& origin, int k) const {
    const Vec3 from_tip = origin - tip;
    const double height = from_tip.dot(axis);
    const double rise = axis[k];
    const double across_1 = axis[(k + 1) % 3];
    const double across_2 = axis[(k + 2) % 3];
    const Line line{across_1 * across_1 + across_2 * across_2,
                    from_tip[k] - height * rise,
                    from_tip.squaredNorm() - height * height,
                    height,
                    rise,
                    origin[k]};
    std::optional<BodyCrossing> found;
    add_shank(line, found);
    add_flank(line, found);
    add_corner(line, found);
    if (found) {
        found->enter += line.origin;
        found->leave += line.origin;
    }
    return found;
}

void BodyRay::add_shank(const Line& line, std::optional<BodyCrossing>& found) const {
    BodyCrossing part = everything();
    if (line.clip_to_cylinder(zones_.shape.radius, Part::shank, part) &&
        line.clip_to_slab(zones_.flank_end, zones_.shape.top, part)) {
        join(part, found);
    }
}

void BodyRay::add_flank(const Line& line, std::optional<BodyCrossing>& found) const {
    if (zones_.flank_end <= zones_.corner_end) {
        return;
    }
    BodyCrossing part = everything();
    if (!line.clip_to_slab(zones_.corner_end, zones_.flank_end, part)) {
        return;
    }
    // rho <= w, with w = radius + tangent (z - corner_end), which is not negative within the slab.
    const double w = zones_.corner_radius + zones_.tangent * (line.height - zones_.corner_end);
    const double w_rise = zones_.tangent * line.rise;
    const double a = line.a - w_rise * w_rise;
    const double b = line.b - w * w_rise;
    const double c = line.c - w * w;
    if (a > parallel) {
        if (clip_to_quadric(a, b, c, Part::flank, part)) {
            join(part, found);
        }
        return;
    }
    if (a > -parallel) { // along a line of the cone
        if (std::abs(b) > 0.0) {
            const double at = -0.5 * c / b;
            b > 0.0 ? lower_leave(part, at, Part::flank) : raise_enter(part, at, Part::flank);
        } else if (c > 0.0) {
            return;
        }
    } else { // steeper than the flank: inside beyond the root where the cone is the wider one
        const double root = std::sqrt(std::max(b * b - a * c, 0.0));
        w_rise > 0.0 ? raise_enter(part, (-b - root) / a, Part::flank)
                     : lower_leave(part, (-b + root) / a, Part::flank);
    }
    if (part.enter < part.leave) {
        join(part, found);
    }
}

void BodyRay::add_corner(const Line& line, std::optional<BodyCrossing>& found) const {
    if (zones_.shape.corner <= 0.0) {
        return;
    }
    BodyCrossing part = everything();
    if (zones_.shape.flat > 0.0) {
        if (line.clip_to_slab(zones_.shape.bottom, zones_.corner_end, part) &&
            line.clip_to_cylinder(zones_.corner_radius, Part::corner, part) && clip_to_torus(line, part)) {
            join(part, found);
        }
        return;
    }
    const double height = line.height - zones_.center;
    if (clip_to_quadric(1.0,
                        line.b + height * line.rise,
                        line.c + height * height - zones_.shape.corner * zones_.shape.corner,
                        Part::corner,
                        part) &&
        line.clip_to_slab(zones_.shape.bottom - zones_.shape.corner, zones_.corner_end, part)) {
        join(part, found);
    }
}

/// Within the slab of the corner the body is where (rho - flat)^2 + (z - center)^2 <= corner^2, or rho below
/// the flat: a convex function, so that Newton's steps from outside never pass its zero.
bool BodyRay::clip_to_torus(const Line& line, BodyCrossing& part) const {
    constexpr int most_steps = 40;
    constexpr double exact = 1e-10; // mm^2; of the radii at hand far below a nanometre
    const auto walk = [&](double& t, Part& by, double sense) {
        for (int n = 0; n < most_steps; ++n) {
            const double rho = std::sqrt(line.rho_squared(t));
            const double beyond = std::max(rho - zones_.shape.flat, 0.0);
            const double height = line.z(t) - zones_.center;
            const double value =
                beyond * beyond + height * height - zones_.shape.corner * zones_.shape.corner;
            if (value <= exact) {
                return true;
            }
            const double slope =
                2.0 * (beyond > 0.0 ? beyond * (line.a * t + line.b) / rho : 0.0) + 2.0 * height * line.rise;
            if (!(slope * sense < 0.0)) {
                return false;
            }
            t -= value / slope;
            by = Part::corner;
        }
        return true;
    };
    return walk(part.enter, part.enter_part, 1.0) && walk(part.leave, part.leave_part, -1.0) &&
           part.enter < part.leave;
}

EndRate BodyRay::rate_of(const MovingPose& pose, const Vec3& at, Part part, int k) const {
    const Vec3 from_tip = at - pose.tip;
    const double z = from_tip.dot(pose.axis);
    const Vec3 radial = from_tip - z * pose.axis;
    Vec3 normal = radial;
    switch (part) {
    case Part::bottom:
        normal = -pose.axis;
        break;
    case Part::top:
        normal = pose.axis;
        break;
    case Part::shank:
        break;
    case Part::flank:
        normal = radial - zones_.tangent * radial.norm() * pose.axis;
        break;
    case Part::corner: {
        const double rho = radial.norm();
        const double beyond = rho > 0.0 ? std::max(rho - zones_.shape.flat, 0.0) / rho : 0.0;
        normal = beyond * radial + (z - zones_.center) * pose.axis;
        break;
    }
    }
    // The body turns about axis x axis_rate: a point at height z along it goes with z axis_rate, one beside
    // it along the axis.
    const Vec3 velocity = pose.tip_rate + z * pose.axis_rate - radial.dot(pose.axis_rate) * pose.axis;
    return {normal.dot(velocity) / normal[k], std::abs(normal[k]) / normal.norm()};
}

} // namespace millwright::simulation
