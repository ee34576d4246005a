// The part of a straight line inside a window (Liang and Barsky 1984).
#pragma once

#include "core/hpgl/internal/pen.h"

namespace millwright::hpgl::internal {

/// Shortens the line to what is inside or on the edge; false if nothing is. Ends that are inside stay as they
/// are.
[[nodiscard]] bool clip(const Window& window, Vec2& from, Vec2& to);

} // namespace millwright::hpgl::internal
