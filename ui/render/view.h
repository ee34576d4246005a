// One look at the scene: matrices, and the way between the scene and the pixels of a picture.
// Scene: mm, z up, right-handed. Pixels: x to the right, y downwards, (0, 0) the top left corner of the
// picture.
#pragma once

#include "ui/render/pixel_size.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace millwright::render {

/// `direction` is a unit vector pointing into the scene.
struct Ray {
    glm::dvec3 origin{};
    glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// Where a scene point appears; `depth` 0 at the near plane, 1 at the far plane.
struct Projected {
    glm::dvec2 pixel{};
    double depth = 0.0;
};

struct View {
    glm::dmat4 view{1.0}; ///< scene to eye (x right, y up, looking along -z); an oblique one shears, too
    glm::dmat4 projection{1.0}; ///< eye to clip
    PixelSize size{1, 1};
    double content_scale = 1.0; ///< widths and sizes of styles are multiplied by it
};

/// Nothing for points at or behind the eye.
[[nodiscard]] std::optional<Projected> project(const View& view, const glm::dvec3& point);

/// The line of sight through a pixel position, from the near plane on.
[[nodiscard]] Ray ray(const View& view, const glm::dvec2& pixel);

/// `view.view` without the shear of an oblique view: what light falls by.
[[nodiscard]] glm::dmat4 unsheared(const View& view);

/// The direction in which the view looks, unit length.
[[nodiscard]] glm::dvec3 looking_along(const View& view);

/// How long one pixel is at `point`, mm, measured across the line of sight.
[[nodiscard]] double pixel_length(const View& view, const glm::dvec3& point);

/// Where the ray meets the plane through `point` across `normal`; nothing if it never does.
[[nodiscard]] std::optional<glm::dvec3>
meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal);

} // namespace millwright::render
