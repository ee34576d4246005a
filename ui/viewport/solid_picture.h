// A body or a surface as a picture for files, without a display.
#pragma once

#include "core/geometry/vectors.h"
#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"
#include "ui/render/view_colors.h"

#include <array>
#include <cstdint>
#include <vector>

namespace millwright::viewport {

/// Triangles with a colour a point, 0 to 255.
struct ColoredSolid {
    const std::vector<Vec3>& points;                  ///< mm
    const std::vector<std::array<int, 3>>& triangles; ///< counter-clockwise seen from outside
    const std::vector<std::array<std::uint8_t, 3>>& colors;
    bool closed = true; ///< false: a surface, seen from both sides
};

/// Seen from the front, right and above, filling the picture. Makes a context of its own, which is current
/// while it draws. Throws Error if there is no EGL or no OpenGL 3.3; Defect without a point.
[[nodiscard]] render::Picture
solid_picture(const ColoredSolid& solid, const render::PixelSize& size, render::Theme theme);

} // namespace millwright::viewport
