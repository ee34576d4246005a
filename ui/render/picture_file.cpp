// The home of stb: pictures to PNG bytes and back.
#include "core/base/error.h"
#include "core/base/files.h"
#include "ui/render/picture.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstring>
#include <limits>
#include <memory>

namespace millwright::render {

namespace {

void append(void* to, void* bytes, int count) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

using Decoded = std::unique_ptr<stbi_uc, decltype(&stbi_image_free)>;

} // namespace

std::string to_png(const Picture& picture) {
    const auto [width, height] = picture.size;
    expects(width > 0 && height > 0, "a picture to be saved is not empty");
    expects(picture.pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
            "a picture has as many pixels as its size says");
    std::string bytes;
    const int stride = width * static_cast<int>(sizeof(Pixel));
    const int done = stbi_write_png_to_func(append, &bytes, width, height, 4, picture.pixels.data(), stride);
    expects(done != 0 && !bytes.empty(), "a picture can be encoded as PNG");
    return bytes;
}

Picture from_image_bytes(std::string_view bytes, const std::filesystem::path& name) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw Error("the picture is larger than 2 GB", name);
    }
    // stb reads unsigned bytes; a copy is cheaper than an argument about aliasing.
    const std::vector<stbi_uc> input(bytes.begin(), bytes.end());
    PixelSize size;
    int channels = 0;
    const int count = static_cast<int>(input.size());
    const Decoded decoded(stbi_load_from_memory(input.data(), count, &size.width, &size.height, &channels, 4),
                          &stbi_image_free);
    if (!decoded) {
        throw Error(std::string("cannot read the picture: ") + stbi_failure_reason(),
                    name,
                    "use a PNG, JPEG or BMP file");
    }
    Picture picture = filled(size, Pixel{});
    std::memcpy(picture.pixels.data(), decoded.get(), picture.pixels.size() * sizeof(Pixel));
    return picture;
}

void write_png(const Picture& picture, const std::filesystem::path& file) {
    write_file(file, to_png(picture));
}

Picture read_picture(const std::filesystem::path& file) {
    return from_image_bytes(read_file(file), file);
}

} // namespace millwright::render
