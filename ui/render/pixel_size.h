// The size of a picture, a window or a view in physical pixels.
#pragma once

namespace millwright::render {

struct PixelSize {
    int width = 0;
    int height = 0;

    friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// width / height; 1 for a size without area.
[[nodiscard]] constexpr double aspect(const PixelSize& size) {
    return size.width > 0 && size.height > 0 ? static_cast<double>(size.width) / size.height : 1.0;
}

} // namespace millwright::render
