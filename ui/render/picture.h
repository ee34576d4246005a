// A picture in memory, its PNG file, and how much two of them differ.
#pragma once

#include "ui/render/pixel_size.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::render {

using Pixel = std::array<std::uint8_t, 4>; ///< red, green, blue, alpha; sRGB, alpha not multiplied in

/// `pixels` has width * height entries, row by row, the top row first.
struct Picture {
    PixelSize size = {};
    std::vector<Pixel> pixels = {};

    /// Throws Defect outside the picture. x to the right, y downwards.
    [[nodiscard]] const Pixel& at(int x, int y) const;

    friend bool operator==(const Picture&, const Picture&) = default;
};

/// Every pixel the same.
[[nodiscard]] Picture filled(const PixelSize& size, const Pixel& pixel);

/// Throws Defect if the picture is empty or has another number of pixels than its size says.
[[nodiscard]] std::string to_png(const Picture& picture);

/// Reads PNG, JPEG or BMP bytes. Throws Error with the reason; `name` is the file it names.
[[nodiscard]] Picture from_image_bytes(std::string_view bytes, const std::filesystem::path& name);

/// A failed write leaves the old file as it was. Throws Error with the file and the reason.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Throws Error with the file and the reason.
[[nodiscard]] Picture read_picture(const std::filesystem::path& file);

struct Difference {
    double mean = 0.0;     ///< mean absolute difference of red, green and blue, 0 to 1
    double fraction = 0.0; ///< part of the pixels that differ by more than the tolerance in any channel
};

/// `tolerance` in steps of 1/255. Throws Defect if the sizes differ.
[[nodiscard]] Difference difference(const Picture& a, const Picture& b, int tolerance = 0);

} // namespace millwright::render
