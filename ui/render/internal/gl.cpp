#include "ui/render/internal/gl.h"

#include <algorithm>

namespace millwright::render {

std::optional<std::string> too_old() {
    const int version = epoxy_gl_version();
    if (epoxy_is_desktop_gl() && version >= 10 * gl_major + gl_minor) {
        return std::nullopt;
    }
    return "OpenGL 3.3 is required, but this system has " + std::to_string(version / 10) + "." +
           std::to_string(version % 10);
}

std::string gl_hint() {
    return "install the graphics driver or the software renderer (Debian: libgl1-mesa-dri)";
}

Picture read_pixels(const PixelSize& size, Alpha alpha) {
    Picture picture = filled(size, Pixel{});
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    for (int below = 0, above = size.height - 1; below < above; ++below, --above) {
        const auto row = [&](int y) { return picture.pixels.begin() + std::ptrdiff_t{y} * size.width; };
        std::swap_ranges(row(below), row(below + 1), row(above));
    }
    if (alpha == Alpha::opaque) {
        std::ranges::for_each(picture.pixels, [](Pixel& pixel) { pixel[3] = 255; });
    }
    return picture;
}

} // namespace millwright::render
