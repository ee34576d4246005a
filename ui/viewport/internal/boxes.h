// Boxes of the core in the scene.
#pragma once

#include "ui/render/convert.h"

#include <span>
#include <vector>

namespace millwright::viewport {

/// The points moved into the scene.
[[nodiscard]] std::vector<glm::dvec3> moved(std::span<const Vec3> points, const Frame& motion);

/// The box's eight corners moved into the scene.
[[nodiscard]] std::vector<glm::dvec3> moved_corners(const Box3& box, const Frame& motion);

/// Half of the diagonal; 0 for an empty box.
[[nodiscard]] double radius(const render::Bounds& box);

/// Of the axes at the origin of a scene with that content.
[[nodiscard]] double origin_axis_length(const render::Bounds& content);

/// The largest of 1, 2, 5 times a power of ten that is not above `length`. For `length` > 0.
[[nodiscard]] double round_length(double length);

} // namespace millwright::viewport
