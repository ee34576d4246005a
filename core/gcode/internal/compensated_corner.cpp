#include "core/gcode/internal/compensated_corner.h"

#include "core/base/units.h"
#include "core/gcode/internal/refusal.h"

#include <algorithm>
#include <cmath>

namespace millwright::gcode::internal {

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
