#include "core/toolpath/cutter.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::toolpath {

namespace {

/// The profile of a shape that may be wrong yet.
ProfileShape profile_of(const CutterShape& cutter) {
    const double radius = 0.5 * cutter.diameter;
    ProfileShape shape{.radius = radius, .top = cutter.length};
    switch (cutter.kind) {
    case CutterKind::point:
        break;
    case CutterKind::ball:
        shape.corner = radius;
        break;
    case CutterKind::flat:
        shape.flat = radius;
        break;
    case CutterKind::bull_nose:
        shape.corner = cutter.corner_radius;
        shape.flat = radius - cutter.corner_radius;
        break;
    case CutterKind::cone:
        shape.corner = cutter.corner_radius;
        shape.half_angle = cutter.half_angle;
        break;
    }
    return shape;
}

/// Where a cone is as thick as its shank, above its tip.
double cone_height(const CutterShape& cutter) {
    const double s = std::sin(cutter.half_angle);
    const double c = std::cos(cutter.half_angle);
    const double widens = 0.5 * cutter.diameter - cutter.corner_radius * c;
    return cutter.corner_radius * (1.0 - s) + widens * c / s;
}

/// Height from which the shank goes up straight.
double cutting_height(const CutterShape& cutter) {
    switch (cutter.kind) {
    case CutterKind::ball:
        return 0.5 * cutter.diameter;
    case CutterKind::bull_nose:
        return cutter.corner_radius;
    case CutterKind::cone:
        return cone_height(cutter);
    case CutterKind::point:
    case CutterKind::flat:
        break;
    }
    return 0.0;
}

bool positive(double length) {
    return std::isfinite(length) && length > 0.0;
}

std::string fault_of_cone(const CutterShape& cutter) {
    if (!(cutter.half_angle > 0.0 && cutter.half_angle < 0.5 * pi)) {
        return fmt::format("the half angle of a tapered cutter must be between 0 and 90 deg, not {:.6g}",
                           to_degrees(cutter.half_angle));
    }
    if (!(cutter.corner_radius * std::cos(cutter.half_angle) <= 0.5 * cutter.diameter)) {
        return fmt::format("a tip radius of {:.6g} mm is too large for a shank diameter of {:.6g} mm",
                           cutter.corner_radius,
                           cutter.diameter);
    }
    return {};
}

} // namespace

std::string fault_of(const CutterShape& cutter) {
    if (cutter.kind == CutterKind::point) {
        return {};
    }
    if (!positive(cutter.diameter) || !positive(cutter.length)) {
        return "the diameter and the length of a cutter must be above 0 mm";
    }
    const bool cornered = cutter.kind == CutterKind::bull_nose || cutter.kind == CutterKind::cone;
    if (cornered && !(std::isfinite(cutter.corner_radius) && cutter.corner_radius >= 0.0)) {
        return "the corner radius of a cutter must be 0 mm or more";
    }
    if (cutter.kind == CutterKind::bull_nose && cutter.corner_radius > 0.5 * cutter.diameter) {
        return fmt::format("a corner radius of {:.6g} mm does not fit into a diameter of {:.6g} mm",
                           cutter.corner_radius,
                           cutter.diameter);
    }
    if (cutter.kind == CutterKind::cone) {
        if (std::string fault = fault_of_cone(cutter); !fault.empty()) {
            return fault;
        }
    }
    const double height = cutting_height(cutter);
    return cutter.length < height
               ? fmt::format("a cutter of length {:.6g} mm ends below its shank, which starts at {:.6g} mm",
                             cutter.length,
                             height)
               : std::string();
}

std::string fault_of(const HolderShape& holder) {
    const bool sound = std::isfinite(holder.diameter) && holder.diameter >= 0.0;
    return sound && (holder.diameter <= 0.0 || positive(holder.length))
               ? std::string()
               : "a holder must have a diameter of 0 mm or more and a length above 0 mm";
}

std::optional<Profile> body_of(const CutterShape& shape) {
    if (const std::string fault = fault_of(shape); !fault.empty()) {
        throw Error(fault);
    }
    return shape.kind == CutterKind::point ? std::nullopt : std::optional<Profile>(profile_of(shape));
}

std::optional<Profile> body_of(const HolderShape& shape, double cutter_length) {
    if (const std::string fault = fault_of(shape); !fault.empty()) {
        throw Error(fault);
    }
    if (shape.diameter <= 0.0) {
        return std::nullopt;
    }
    const double radius = 0.5 * shape.diameter;
    return Profile(
        {.flat = radius, .radius = radius, .bottom = cutter_length, .top = cutter_length + shape.length});
}

Vec3 contact_from_tip(const Profile& body, const Vec3& normal, const Vec3& axis) {
    const double cosine = normal.dot(axis);
    const Vec3 across = cosine * axis - normal; // from the axis towards the contact
    const double sine = across.norm();
    const Vec2 at = body.support({sine, -cosine});
    return at.y() * axis + (sine > 0.0 ? Vec3(at.x() / sine * across) : Vec3(Vec3::Zero()));
}

Vec3 tip_for(const Profile& body, const Vec3& contact, const Vec3& normal, const Vec3& axis) {
    return contact - contact_from_tip(body, normal, axis);
}

} // namespace millwright::toolpath
