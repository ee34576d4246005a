#include "ui/render/internal/read_pixels.h"

#include "ui/render/internal/gl.h"

#include <algorithm>

namespace millwright::render {

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
