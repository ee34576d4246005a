// How large the window is, to be kept from one start to the next.
#pragma once

#include "ui/render/pixel_size.h"

namespace millwright::render {

struct WindowPlace {
    PixelSize size = {1280, 800}; ///< pixels at scale 1; of a maximized window: before it became that
    bool maximized = false;

    friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

} // namespace millwright::render
