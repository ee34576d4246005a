#include "ui/render/picture.h"

#include "core/base/error.h"

#include <algorithm>
#include <cstdlib>

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

} // namespace millwright::render
