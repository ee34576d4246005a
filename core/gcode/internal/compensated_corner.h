// Where two offset elements of a contour meet. Everything lies in a plane; the side is +1 for a tool on the
// left of the motion and -1 for one on its right.
#pragma once

#include "core/geometry/vectors.h"

#include <cstdint>

namespace millwright::gcode::internal {

/// A straight line or an arc of the contour at a corner.
struct PathElement {
    Vec2 direction = Vec2::Zero(); ///< of the motion at the corner, a unit vector
    bool is_arc = false;
    Vec2 centre = Vec2::Zero();
    double offset_radius = 0.0; ///< of the arc that the tool's centre runs on
    int turns = 0;              ///< > 0 counter-clockwise
};

enum class Corner : std::uint8_t {
    convex,  ///< the tool goes round the outside
    concave, ///< the tool stays in the angle
    smooth   ///< one element goes on where the other ends
};

/// Whether the tool runs on the inner side of an arc.
[[nodiscard]] constexpr bool tool_inside_arc(int turns, double side) {
    return (turns > 0) == (side > 0.0);
}

/// Turns of less than 0.05 rad are smooth (LinuxCNC's TOLERANCE_CONCAVE_CORNER).
[[nodiscard]] Corner corner_between(const PathElement& before, const PathElement& next, double side);

struct ConcaveCorner {
    PathElement before, next;
    Vec2 corner;   ///< as programmed
    Vec2 tool;     ///< the centre of the tool at the end of `before`
    double radius; ///< of the tool
    double side;
};

/// Where the offset paths of both elements cross. Throws Refusal if the tool does not fit.
[[nodiscard]] Vec2 meeting_point(const ConcaveCorner& c);

} // namespace millwright::gcode::internal
