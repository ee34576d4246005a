// An axis-aligned box in scene coordinates (mm), the view's own counterpart of the core's Box3.
#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace millwright::render {

/// Empty while any min is above its max, as a new one is.
struct Bounds {
    glm::dvec3 min{1.0};
    glm::dvec3 max{-1.0};
};

[[nodiscard]] bool is_empty(const Bounds& box);
[[nodiscard]] glm::dvec3 center(const Bounds& box);
[[nodiscard]] std::array<glm::dvec3, 8> corners(const Bounds& box);

/// The smallest box around both; an empty one adds nothing.
[[nodiscard]] Bounds united(const Bounds& a, const Bounds& b);
[[nodiscard]] Bounds united(const Bounds& box, const glm::dvec3& point);

} // namespace millwright::render
