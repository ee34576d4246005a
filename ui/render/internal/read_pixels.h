// Pixels of the framebuffer that is bound for reading.
#pragma once

#include "ui/render/picture.h"

namespace millwright::render {

enum class Alpha { kept, opaque };

/// From the lower left corner of the framebuffer; the picture has its top row first.
[[nodiscard]] Picture read_pixels(const PixelSize& size, Alpha alpha);

} // namespace millwright::render
