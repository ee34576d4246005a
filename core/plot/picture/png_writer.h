// Gray pictures as PNG files: what previews are saved as.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::plot {

/// Rows from the top, each from the left.
struct GrayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels; ///< 0 black, 255 white

    friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

/// The bytes of a PNG of 8 bits per pixel. Throws Defect unless there are as many pixels as the size says, at
/// least one.
[[nodiscard]] std::string png_bytes(const GrayImage& image);

} // namespace millwright::plot
