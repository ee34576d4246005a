// Picture files made for tests by the libraries that define their formats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::plot {

/// Samples of a picture, rows from the top.
struct Samples {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<std::uint16_t> values;
};

/// Any value of `bits` in each sample, from a fixed seed.
[[nodiscard]] Samples noise(int width, int height, int channels, int bits);

struct PngKind {
    int bits = 8;
    bool palette = false; ///< of 256 grays, darkest last
    bool interlaced = false;
    int pixels_per_metre = 0;
    int rows_per_metre = 0; ///< 0: as many
    bool in_metres = true;  ///< else the two say the shape alone
};

/// 1, 2, 3 or 4 channels: gray, gray and opacity, RGB, RGB and opacity.
[[nodiscard]] std::string png_of(const Samples& samples, const PngKind& kind = {});

struct JpegKind {
    bool progressive = false;
    int dots_per_inch = 0;
    int rows_per_inch = 0; ///< 0: as many
    bool adobe = true;     ///< of four inks: marked, and inverted, as Adobe's are
};

/// 1, 3 or 4 channels of 8 bits: gray, RGB, inks.
[[nodiscard]] std::string jpeg_of(const Samples& samples, const JpegKind& kind = {});

/// The lowest `count` bytes of `value`, lowest first.
void append_little_endian(std::string& bytes, std::uint32_t value, int count);

/// 8 bits a channel, RGB; of `bits` 24 or 32, and upside down unless `top_down`.
[[nodiscard]] std::string bmp_of(const Samples& samples, int bits, bool top_down);

} // namespace millwright::plot
