#include "core/plot/picture/png_writer.h"

#include "core/base/error.h"

#include <png.h>

namespace millwright::plot {

std::string png_bytes(const GrayImage& image) {
    expects(image.width > 0 && image.height > 0 &&
                image.pixels.size() ==
                    static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
            "an image has as many pixels as its size says");
    png_image head = {};
    head.version = PNG_IMAGE_VERSION;
    head.width = static_cast<png_uint_32>(image.width);
    head.height = static_cast<png_uint_32>(image.height);
    head.format = PNG_FORMAT_GRAY;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
    std::string bytes(size, '\0');
    const int done =
        png_image_write_to_memory(&head, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
    expects(done != 0, "a picture in memory becomes a PNG");
    bytes.resize(size);
    return bytes;
}

} // namespace millwright::plot
