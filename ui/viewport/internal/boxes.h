// Boxes of the core in the scene.
#pragma once

#include "ui/render/convert.h"

namespace millwright::viewport {

/// The scene's box around a moved one; empty for an empty one.
[[nodiscard]] render::Bounds transformed(const Box3& box, const Frame& motion);

/// Half of the diagonal; 0 for an empty box.
[[nodiscard]] double radius(const render::Bounds& box);

/// The largest of 1, 2, 5 times a power of ten that is not above `length`. For `length` > 0.
[[nodiscard]] double round_length(double length);

} // namespace millwright::viewport
