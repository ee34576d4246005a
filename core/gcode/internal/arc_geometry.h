// Arcs in a plane: centre and sweep from what a program says of them. Coordinates are the plane's first and
// second; a positive turn goes from the first axis to the second.
#pragma once

#include "core/gcode/dialect.h"
#include "core/gcode/modal_state.h"
#include "core/geometry/vectors.h"

#include <string>

namespace millwright::gcode::internal {

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

} // namespace millwright::gcode::internal
