// Geometry in a program's plane: arcs, and where two offset elements of a contour meet.
#pragma once

#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"
#include "core/geometry/vectors.h"

#include <cstdint>
#include <string>

namespace millwright::gcode::internal {

// Arcs in a plane: centre and sweep from what a program says of them. Coordinates are the plane's first and
// second; a positive turn goes from the first axis to the second.

/// The plane's name of its axes, for messages: "XY".
[[nodiscard]] std::string plane_letters(Plane plane);

/// How far an arc may be from a circle.
struct ArcTolerances {
    double smallest_radius;     ///< below it counts as none
    double free_difference;     ///< of the radii at start and end, never refused
    double greatest_difference; ///< of the radii, always refused; between both it must be small relatively
    double largest_radius;
};

/// Those of the dialect, in the program's unit; the largest radius is ours (1 km).
[[nodiscard]] ArcTolerances arc_tolerances(LengthUnit unit, Dialect dialect);

/// The centre of the arc of radius |r| from `start` to `end`: the shorter way for r > 0, the longer one for
/// r < 0. `turns` > 0 is counter-clockwise; half the chord may exceed the radius by `tolerance`. Throws
/// Refusal at `column` if there is none.
[[nodiscard]] Vec2
centre_from_radius(const Vec2& start, const Vec2& end, double r, int turns, double tolerance, int column);

/// Throws Refusal at `column` unless both ends are as far from the centre, within tolerances. `plane` is for
/// the message.
void check_centre(const Vec2& start,
                  const Vec2& end,
                  const Vec2& centre,
                  const ArcTolerances& within,
                  Plane plane,
                  int column);

/// The whole turn, rad, with the sign of `turns`. Ends that lie at the same angle, or within hair_sweep
/// beyond it, make a full turn.
[[nodiscard]] double sweep_of(const Vec2& start, const Vec2& end, const Vec2& centre, int turns);

// Where two offset elements of a contour meet. Everything lies in a plane; the side is +1 for a tool on the
// left of the motion and -1 for one on its right.

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
