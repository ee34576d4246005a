// Where meshes, lines and points take their colours from, and how they meet what is already drawn.
#pragma once

#include "ui/render/color_map.h"

#include <glm/vec4.hpp>

namespace millwright::render {

enum class ColorFrom {
    style,  ///< `color` of the style for everything
    vertex, ///< the vertices' own colours
    value,  ///< the vertices' values through `scale`
};

struct Coloring {
    ColorFrom from = ColorFrom::style;
    glm::vec4 color{1.0F}; ///< sRGB with opacity
    ColorScale scale = {};
    float opacity = 1.0F; ///< multiplies every opacity
};

enum class Depth {
    tested,  ///< hidden by what is in front, hides what is behind
    overlay, ///< always in front, hides nothing
    ghost,   ///< hidden by what is in front, hides nothing itself (for see-through things, drawn last)
};

} // namespace millwright::render
