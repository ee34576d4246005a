#include "core/gcode/internal/plane_geometry.h"

#include "core/base/units.h"
#include "core/gcode/canon.h"
#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

constexpr double smallest_radius_inch = 0.00005;                       // LinuxCNC's RADIUS_TOLERANCE_INCH
constexpr double radius_difference_inch = 2.0 * 0.001 * 1.41421356237; // ends rounded to 0.001 inch
constexpr double radius_difference_mm = 2.0 * 0.01 * 1.41421356237;    // ... to 0.01 mm
constexpr double relative_difference = 0.001;
constexpr double largest_radius_mm = 1e6;

/// An R arc over a chord of less than this times R: its ends are one point, and the direction to its centre
/// is left to rounding.
constexpr double shortest_chord = 1e-6;

/// A chord may be longer than the diameter by so much, relatively: a semicircle with rounded ends.
constexpr double semicircle_within = 1e-12;

} // namespace

std::string plane_letters(Plane plane) {
    switch (plane) {
    case Plane::xz:
        return "XZ";
    case Plane::yz:
        return "YZ";
    case Plane::uv:
        return "UV";
    case Plane::uw:
        return "UW";
    case Plane::vw:
        return "VW";
    case Plane::xy:
        break;
    }
    return "XY";
}

ArcTolerances arc_tolerances(LengthUnit unit, Dialect dialect) {
    const double mm = unit == LengthUnit::mm ? 1.0 : 1.0 / mm_per_inch;
    ArcTolerances within{smallest_radius_inch * mm_per_inch * mm, 0.0, 0.0, largest_radius_mm * mm};
    if (dialect == Dialect::grbl) {
        within.free_difference = 0.005 * mm; // of gcode.c, as the next one
        within.greatest_difference = 0.5 * mm;
    } else {
        within.free_difference = unit == LengthUnit::inch ? radius_difference_inch : radius_difference_mm;
        within.greatest_difference = 100.0 * within.free_difference;
    }
    return within;
}

Vec2 centre_from_radius(
    const Vec2& start, const Vec2& end, double r, int turns, double tolerance, int column) {
    const Vec2 chord = end - start;
    const double half = 0.5 * chord.norm();
    const double radius = std::abs(r);
    if (!(half > 0.0)) {
        refuse(column,
               "an arc given by its radius cannot end where it starts",
               "a full circle needs its centre");
    }
    if (half - radius > tolerance) {
        refuse(column,
               fmt::format(
                   "the radius {:.4f} is too small to reach the end: it is {:.4f} away", radius, 2.0 * half));
    }
    if (2.0 * half < shortest_chord * radius) {
        refuse(column, "the ends of the arc are too close together for the radius to determine its centre");
    }
    const double sine = half > radius * (1.0 - semicircle_within) ? 1.0 : half / radius;
    const double offset = radius * std::sqrt(std::max(0.0, 1.0 - sine * sine));
    // To the left of the chord for the shorter way counter-clockwise and for the longer one clockwise.
    const double side = (turns > 0) == (r > 0.0) ? 1.0 : -1.0;
    const Vec2 left(-chord.y(), chord.x());
    return 0.5 * (start + end) + side * offset * left / chord.norm();
}

void check_centre(const Vec2& start,
                  const Vec2& end,
                  const Vec2& centre,
                  const ArcTolerances& within,
                  Plane plane,
                  int column) {
    const double at_start = (start - centre).norm();
    const double at_end = (end - centre).norm();
    if (!(at_start >= within.smallest_radius && at_end >= within.smallest_radius)) {
        refuse(column,
               fmt::format(
                   "the arc has a zero radius: {:.5f} at its start, {:.5f} at its end", at_start, at_end));
    }
    const double difference = std::abs(at_start - at_end);
    const bool too_different = difference > within.greatest_difference ||
                               difference > relative_difference * std::max(at_start, at_end);
    if (difference > within.free_difference && too_different) {
        refuse(column,
               fmt::format("the arc's radius is {:.4f} at its start and {:.4f} at its end: not a circle "
                           "about {} {:.4f} {:.4f}",
                           at_start,
                           at_end,
                           plane_letters(plane),
                           centre.x(),
                           centre.y()));
    }
    if (!(at_start <= within.largest_radius)) {
        refuse(column, fmt::format("the radius {:.0f} is larger than 1 km", at_start));
    }
}

double sweep_of(const Vec2& start, const Vec2& end, const Vec2& centre, int turns) {
    const Vec2 from = start - centre;
    const Vec2 to = end - centre;
    const double direction = turns > 0 ? 1.0 : -1.0;
    double partial = direction * (std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x()));
    if (partial < 0.0) {
        partial += 2.0 * pi;
    }
    if (partial < hair_sweep) {
        partial += 2.0 * pi;
    }
    return direction * (partial + 2.0 * pi * (std::abs(turns) - 1));
}

namespace {

constexpr double smooth_below = 0.05; // rad

Vec2 left_of(const Vec2& v) {
    return {-v.y(), v.x()};
}

/// By how much the contour turns away from the tool: from -90 to 270 degrees, so that a reversal is convex.
double turn_away(const PathElement& before, const PathElement& next, double side) {
    double turn =
        -side * std::atan2(cross(before.direction, next.direction), before.direction.dot(next.direction));
    if (turn < -0.5 * pi) {
        turn += 2.0 * pi;
    }
    return turn;
}

[[noreturn]] void refuse_fit() {
    refuse(1, "the tool does not fit into this corner without gouging");
}

/// The crossing of the circle about `centre` with the line through `point` along the unit vector `direction`,
/// on the side of the centre that `ahead` says.
Vec2 on_circle(const Vec2& centre, double radius, const Vec2& point, const Vec2& direction, bool ahead) {
    const double across = cross(direction, point - centre);
    if (!(std::abs(across) <= radius)) {
        refuse_fit();
    }
    const double along = std::sqrt(std::max(0.0, radius * radius - across * across));
    return centre + across * left_of(direction) + (ahead ? along : -along) * direction;
}

Vec2 between_lines(const ConcaveCorner& c) {
    const Vec2 n1 = c.side * left_of(c.before.direction);
    const Vec2 n2 = c.side * left_of(c.next.direction);
    const double denominator = 1.0 + n1.dot(n2);
    if (!(denominator > 0.0)) {
        refuse(1, "a zero-degree corner has no room for the tool");
    }
    return c.corner + c.radius / denominator * (n1 + n2);
}

Vec2 between_arcs(const ConcaveCorner& c) {
    const double r1 = c.before.offset_radius;
    const double r2 = c.next.offset_radius;
    const Vec2 apart = c.next.centre - c.before.centre;
    const double distance = apart.norm();
    if (!(r1 > 0.0 && distance > 0.0)) {
        refuse(1, "two arcs about the same centre do not form a corner");
    }
    const double cosine = (r1 * r1 + distance * distance - r2 * r2) / (2.0 * r1 * distance);
    if (!(std::abs(cosine) <= 1.0)) {
        refuse_fit();
    }
    const bool ahead = tool_inside_arc(c.before.turns, c.side) == (c.next.turns > 0);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const Vec2 u = apart / distance;
    return c.before.centre + r1 * (cosine * u + (ahead ? sine : -sine) * left_of(u));
}

} // namespace

Corner corner_between(const PathElement& before, const PathElement& next, double side) {
    const double turn = turn_away(before, next, side);
    const bool reverses = std::abs(turn - pi) < smooth_below;
    // A tool on the outside of an arc that meets the other element head-on stays above both.
    const bool between_outsides =
        reverses && ((next.is_arc && !tool_inside_arc(next.turns, side)) ||
                     (!next.is_arc && before.is_arc && !tool_inside_arc(before.turns, side)));
    if (turn < -smooth_below || turn > pi + smooth_below || between_outsides) {
        return Corner::concave;
    }
    return turn > smooth_below ? Corner::convex : Corner::smooth;
}

Vec2 meeting_point(const ConcaveCorner& c) {
    if (c.before.is_arc && c.next.is_arc) {
        return between_arcs(c);
    }
    if (c.next.is_arc) {
        return on_circle(c.next.centre,
                         c.next.offset_radius,
                         c.tool,
                         c.before.direction,
                         tool_inside_arc(c.next.turns, c.side));
    }
    if (c.before.is_arc) {
        const Vec2 on_line = c.corner + c.radius * c.side * left_of(c.next.direction);
        return on_circle(c.before.centre,
                         c.before.offset_radius,
                         on_line,
                         c.next.direction,
                         !tool_inside_arc(c.before.turns, c.side));
    }
    return between_lines(c);
}

} // namespace millwright::gcode::internal
