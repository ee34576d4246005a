// Control nets turned about z through their origin, counter-clockwise seen from above.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/bspline_surface.h"

namespace millwright::geometry {

/// `turn` in rad.
[[nodiscard]] ControlNet turned(ControlNet net, double turn);
[[nodiscard]] BsplineNet turned(BsplineNet net, double turn);

} // namespace millwright::geometry
