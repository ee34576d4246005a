#include "ui/render/picture.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

namespace millwright::render {

namespace {

std::size_t pixel_count(const PixelSize& size) {
    expects(size.width >= 0 && size.height >= 0, "a picture has no negative size");
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

} // namespace

const Pixel& Picture::at(int x, int y) const {
    expects(x >= 0 && y >= 0 && x < size.width && y < size.height, "the pixel is inside the picture");
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width);
    return pixels.at(row + static_cast<std::size_t>(x));
}

Picture filled(const PixelSize& size, const Pixel& pixel) {
    return {.size = size, .pixels = std::vector<Pixel>(pixel_count(size), pixel)};
}

Difference difference(const Picture& a, const Picture& b, int tolerance) {
    expects(a.size == b.size && a.pixels.size() == b.pixels.size(), "compared pictures have the same size");
    if (a.pixels.empty()) {
        return {};
    }
    double sum = 0.0;
    std::ptrdiff_t differing = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        int largest = 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const int step = std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            largest = std::max(largest, step);
            sum += step;
        }
        largest = std::max(largest, std::abs(a.pixels[i][3] - b.pixels[i][3]));
        differing += largest > tolerance ? 1 : 0;
    }
    const auto count = static_cast<double>(a.pixels.size());
    return {.mean = sum / (3.0 * 255.0 * count), .fraction = static_cast<double>(differing) / count};
}

// The home of stb: pictures to PNG bytes and back.

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
