#include "core/toolpath/profile.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::toolpath {

namespace {

const Vec2 down(0.0, -1.0);

bool is_sound(const ProfileShape& s) {
    const bool finite = std::isfinite(s.flat) && std::isfinite(s.corner) && std::isfinite(s.radius) &&
                        std::isfinite(s.bottom) && std::isfinite(s.top);
    return finite && s.flat >= 0.0 && s.corner >= 0.0 && s.radius > 0.0 && s.half_angle >= 0.0 &&
           s.half_angle < 0.5 * pi;
}

/// (rho, z) of a point in space, and the direction in which rho is counted.
struct Section {
    Vec2 at = Vec2::Zero();
    Vec3 outwards = Vec3::Zero();
};

Section section_of(const geometry::ToolPose& pose, const Vec3& point) {
    const Vec3 from_tip = point - pose.tip;
    const double z = from_tip.dot(pose.axis);
    const Vec3 radial = from_tip - z * pose.axis;
    const double rho = radial.norm();
    return {{rho, z}, rho > 0.0 ? Vec3(radial / rho) : pose.axis.unitOrthogonal()};
}

} // namespace

Profile::Profile(const ProfileShape& shape) : shape_(shape) {
    expects(is_sound(shape), "a profile has finite lengths that are not negative");
    const double c = std::cos(shape.half_angle);
    const double s = std::sin(shape.half_angle);
    flank_normal_ = {c, -s};
    center_ = {shape.flat, shape.bottom + shape.corner};
    flank_from_ = center_ + shape.corner * flank_normal_;
    constexpr double rounding = 1e-9; // mm
    const double widens = shape.radius - flank_from_.x();
    expects(widens >= -rounding, "the shank of a profile is not thinner than its corner");
    expects(s > 0.0 || widens <= rounding, "an upright flank does not widen");
    const double height = s > 0.0 ? std::max(widens, 0.0) * c / s : 0.0;
    flank_to_ = {shape.radius, flank_from_.y() + height};
    expects(flank_to_.y() <= shape.top + rounding, "the top of a profile is above its flank");
    const Vec2 rim(shape.radius, shape.top);
    lines_ = {{{{0.0, shape.bottom}, {shape.flat, shape.bottom}, down},
               {flank_from_, flank_to_, flank_normal_},
               {flank_to_, rim, Vec2::UnitX()},
               {rim, {0.0, shape.top}, Vec2::UnitY()}}};
}

Vec2 Profile::support(const Vec2& direction) const {
    const Vec2 d = direction.normalized();
    constexpr double square_to = 1e-7; // rad: below it the edge of a flat that leads is noise
    const bool downwards = d.y() < 0.0;
    if (d.x() < square_to && (shape_.flat > 0.0 || !downwards)) {
        return {0.0, downwards ? shape_.bottom : shape_.top};
    }
    if (cross(d, flank_normal_) >= 0.0) {
        return center_ + shape_.corner * d;
    }
    return d.y() <= 0.0 ? flank_to_ : Vec2(shape_.radius, shape_.top);
}

bool Profile::faces_corner(const Vec2& from_center) const {
    return from_center.x() >= 0.0 && cross(from_center, flank_normal_) >= 0.0;
}

bool Profile::inside(const Vec2& point) const {
    for (const Line& line : lines_) {
        if ((point - line.from).dot(line.normal) > 0.0) {
            return false;
        }
    }
    const Vec2 from_center = point - center_;
    return !faces_corner(from_center) || from_center.norm() <= shape_.corner;
}

Profile::Near Profile::near(const Vec2& point) const {
    const bool within = inside(point);
    Near found{std::numeric_limits<double>::infinity(), Vec2::UnitY(), 0.0};
    for (const Line& line : lines_) {
        const Vec2 span = line.to - line.from;
        const double square = span.squaredNorm();
        const double t = square > 0.0 ? (point - line.from).dot(span) / square : 0.0;
        const Vec2 off = point - (line.from + std::clamp(t, 0.0, 1.0) * span);
        const double distance = off.norm();
        if (distance < found.distance) {
            const bool at_end = square <= 0.0 || t <= 0.0 || t >= 1.0;
            const bool rounded = at_end && !within && distance > 0.0; // around an edge
            found = {distance, rounded ? Vec2(off / distance) : line.normal, rounded ? 1.0 / distance : 0.0};
        }
    }
    const Vec2 from_center = point - center_;
    const double to_center = from_center.norm();
    if (faces_corner(from_center) && shape_.corner > 0.0) {
        const double distance = std::abs(to_center - shape_.corner);
        if (distance <= found.distance) {
            const bool on_center = to_center <= 0.0;
            found = {distance,
                     on_center ? down : Vec2(from_center / to_center),
                     on_center ? 1.0 / shape_.corner : 1.0 / to_center};
        }
    }
    found.distance = within ? -found.distance : found.distance;
    return found;
}

std::vector<Vec2> Profile::outline(double tolerance) const {
    expects(tolerance > 0.0, "an outline has a tolerance");
    std::vector<Vec2> points{lines_[0].from, lines_[0].to};
    const double sweep = 0.5 * pi - shape_.half_angle;
    if (shape_.corner > 0.0) {
        const double step = 2.0 * std::acos(1.0 - std::min(tolerance / shape_.corner, 1.0));
        const int chords = std::clamp(static_cast<int>(std::ceil(sweep / step)), 2, 256);
        for (int k = 1; k <= chords; ++k) {
            const double angle = sweep * k / chords; // from the bottom's normal
            points.emplace_back(center_ + shape_.corner * Vec2(std::sin(angle), -std::cos(angle)));
        }
    }
    for (std::size_t n = 1; n < lines_.size(); ++n) {
        points.push_back(lines_[n].to);
    }
    constexpr double same = 1e-9; // mm
    const auto last = std::unique(
        points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return (a - b).norm() < same; });
    points.erase(last, points.end());
    return points;
}

BodyNear near(const Profile& body, const geometry::ToolPose& pose, const Vec3& point) {
    const Section section = section_of(pose, point);
    const Profile::Near seen = body.near(section.at);
    constexpr double on_axis = 1e-9; // mm
    const double rho = section.at.x();
    const double parallel = rho > on_axis ? seen.normal.x() / rho : seen.meridian_curvature;
    const Vec3 meridian = -seen.normal.y() * section.outwards + seen.normal.x() * pose.axis;
    const Vec3 around = pose.axis.cross(section.outwards);
    return {seen.distance,
            seen.normal.x() * section.outwards + seen.normal.y() * pose.axis,
            seen.meridian_curvature * meridian * meridian.transpose() +
                parallel * around * around.transpose()};
}

double
height_over(const Profile& body, const geometry::ToolPose& pose, const Vec3& point, const Vec3& direction) {
    return height_below(body, pose, point, direction, std::numeric_limits<double>::infinity());
}

double height_below(const Profile& body,
                    const geometry::ToolPose& pose,
                    const Vec3& point,
                    const Vec3& direction,
                    double enough) {
    constexpr int most_steps = 100;
    constexpr double exact = 1e-11; // mm
    const ProfileShape& shape = body.shape();
    const bool inside = distance(body, pose, point) < 0.0;
    // The distance is convex along a line. Newton's steps towards its zero never pass it: upwards from a
    // point outside, or up again from below the whole body.
    double height = inside ? -2.0 * (shape.top - shape.bottom + 2.0 * shape.radius) : 0.0;
    for (int n = 0; n < most_steps; ++n) {
        const Section section = section_of(pose, point + height * direction);
        const Profile::Near seen = body.near(section.at);
        const Vec3 normal = seen.normal.x() * section.outwards + seen.normal.y() * pose.axis;
        const double slope = normal.dot(direction);
        if (seen.distance <= exact || height >= enough) {
            return height;
        }
        if (!(slope < 0.0)) {
            return std::numeric_limits<double>::infinity(); // past the body: from here it gets farther
        }
        height -= seen.distance / slope;
    }
    return height;
}

double distance(const Profile& body, const geometry::ToolPose& pose, const Vec3& point) {
    return body.near(section_of(pose, point).at).distance;
}

} // namespace millwright::toolpath
