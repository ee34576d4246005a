// The pixel under the mouse pointer, in the coordinates of a view.
#pragma once

#include "ui/widgets/canvas.h"

#include <glm/vec2.hpp>

namespace millwright::viewport {

[[nodiscard]] inline glm::dvec2 pixel_of(const widgets::Pointer& pointer) {
    return {static_cast<double>(pointer.at.x), static_cast<double>(pointer.at.y)};
}

} // namespace millwright::viewport
