// Where a patch passes through itself, so that no tool can cut it from one side.
#pragma once

#include "core/geometry/parametric_surface.h"

#include <optional>

namespace millwright::geometry {

/// Two places (u, v) of a patch at one point of space.
struct SelfCrossing {
    Vec2 first, second;
};

/// Of the triangles over `cells` x `cells` equal cells of the parameters two that cross each other, or two of
/// its corners inside the patch that lie on each other; nothing where there are none. Sides of the patch may
/// touch (a tube, a pole). What is finer than a cell is missed.
[[nodiscard]] std::optional<SelfCrossing> self_crossing(const ParametricSurface& patch, int cells = 24);

} // namespace millwright::geometry
