// A picture whose pixels have a shape of their own, as scanners write them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace millwright::test {

/// 24 bits, brighter from the left to the right and from below to the top; so many pixels per metre across
/// and down.
inline void write_bmp(const std::filesystem::path& file, int width, int height, int across, int down) {
    constexpr int head = 54, channels = 3, most = 255;
    std::string bytes = "BM";
    const auto put = [&](int value, int count) {
        for (int n = 0; n < count; ++n) {
            bytes += static_cast<char>(static_cast<std::uint32_t>(value) >> (8 * n) & 0xFFU);
        }
    };
    const int padding = (4 - width * channels % 4) % 4;
    put(head + (width * channels + padding) * height, 4);
    put(0, 4);
    put(head, 4);
    put(40, 4);
    put(width, 4);
    put(height, 4);
    put(1, 2);
    put(8 * channels, 2);
    put(0, 4);
    put(0, 4);
    put(across, 4);
    put(down, 4);
    put(0, 4);
    put(0, 4);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            bytes.append(channels, static_cast<char>(most * (x + y) / (width + height)));
        }
        bytes.append(static_cast<std::size_t>(padding), '\0');
    }
    std::ofstream(file, std::ios::binary) << bytes;
}

} // namespace millwright::test
