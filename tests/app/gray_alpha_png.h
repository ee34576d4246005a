// A small square PNG of gray and opacity, as a program for logos writes it, without compression.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace millwright::test {

struct GrayAlpha {
    unsigned char gray = 0, opacity = 255;
};

inline std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
        bytes.push_back(static_cast<char>(value >> shift));
    }
    return bytes;
}

/// Length, type, data and their CRC-32 (ISO 3309), as a chunk of PNG has it.
inline std::string png_chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = ~0U;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

/// `size` x `size` pixels, rows from the top; at most 180.
inline std::string gray_alpha_png(int size, const std::function<GrayAlpha(int x, int y)>& at) {
    using namespace std::string_literals;
    std::string rows;
    for (int y = 0; y < size; ++y) {
        rows.push_back('\0'); // no filter
        for (int x = 0; x < size; ++x) {
            const GrayAlpha pixel = at(x, y);
            rows.push_back(static_cast<char>(pixel.gray));
            rows.push_back(static_cast<char>(pixel.opacity));
        }
    }
    std::uint32_t a = 1, b = 0; // Adler-32
    for (const char c : rows) {
        a = (a + static_cast<unsigned char>(c)) % 65521U;
        b = (b + a) % 65521U;
    }
    const auto length = static_cast<std::uint32_t>(rows.size());
    std::string stored = "\x78\x01\x01"s; // zlib, one last block as it is
    for (const std::uint32_t part : {length, ~length}) {
        stored.push_back(static_cast<char>(part));
        stored.push_back(static_cast<char>(part >> 8U));
    }
    stored += rows + big_endian((b << 16U) | a);
    const auto edge = static_cast<std::uint32_t>(size);
    return "\x89PNG\r\n\x1A\n"s + png_chunk("IHDR", big_endian(edge) + big_endian(edge) + "\x08\x04\0\0\0"s) +
           png_chunk("IDAT", stored) + png_chunk("IEND", "");
}

} // namespace millwright::test
