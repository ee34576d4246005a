#include "core/base/error.h"
#include "core/plot/picture/picture.h"
#include "tests/core/plot/picture/made_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace millwright::plot {
namespace {

using testing::HasSubstr;
using Indices = std::vector<unsigned char>;

/// A BMP with a palette of grays n, of 4 or 8 bits.
std::string bmp(int width, int height, int bits, std::uint32_t compression, const std::string& pixels) {
    const std::uint32_t colors = 1U << static_cast<unsigned>(bits);
    std::string bytes = "BM";
    append_little_endian(bytes, 0, 8);
    append_little_endian(bytes, 54 + 4 * colors, 4);
    append_little_endian(bytes, 40, 4);
    append_little_endian(bytes, static_cast<std::uint32_t>(width), 4);
    append_little_endian(bytes, static_cast<std::uint32_t>(height), 4);
    append_little_endian(bytes, 1, 2);
    append_little_endian(bytes, static_cast<std::uint32_t>(bits), 2);
    append_little_endian(bytes, compression, 4);
    append_little_endian(bytes, 0, 4 * 5);
    for (std::uint32_t n = 0; n < colors; ++n) {
        append_little_endian(bytes, n * 0x010101, 4);
    }
    return bytes + pixels;
}

std::string of_bytes(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) {
        bytes.push_back(static_cast<char>(value));
    }
    return bytes;
}

std::string codes_bmp(int width, int height, int bits, const std::string& codes) {
    return bmp(width, height, bits, bits == 8 ? 1 : 2, codes);
}

Indices indices_of(const std::string& bytes) {
    Indices indices;
    for (const std::uint16_t gray : read_picture(bytes, "runs.bmp", {}).picture.gray) {
        indices.push_back(static_cast<unsigned char>(gray / 257));
    }
    return indices;
}

std::string bmp_error(const std::string& bytes) {
    try {
        (void)read_picture(bytes, "runs.bmp", {});
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "no error";
}

// The examples of the format's description (Microsoft, Bitmap Compression), rows turned to come from the top.
TEST(BmpRuns, ReadsTheExampleOf8Bits) {
    const std::string codes =
        of_bytes({0x03, 0x04, 0x05, 0x06, 0x00, 0x03, 0x45, 0x56, 0x67, 0x00, 0x02, 0x78,
                  0x00, 0x02, 0x05, 0x01, 0x02, 0x78, 0x00, 0x00, 0x09, 0x1e, 0x00, 0x01});
    const Indices top{0x1e, 0x1e, 0x1e, 0x1e, 0x1e, 0x1e, 0x1e, 0x1e, 0x1e, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const Indices middle{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x78, 0x78};
    const Indices bottom{4, 4, 4, 6, 6, 6, 6, 6, 0x45, 0x56, 0x67, 0x78, 0x78, 0, 0, 0, 0, 0, 0, 0};
    Indices all = top;
    all.insert(all.end(), middle.begin(), middle.end());
    all.insert(all.end(), bottom.begin(), bottom.end());
    EXPECT_EQ(indices_of(codes_bmp(20, 3, 8, codes)), all);
}

TEST(BmpRuns, ReadsTheExampleOf4Bits) {
    const std::string codes =
        of_bytes({0x03, 0x04, 0x05, 0x06, 0x00, 0x06, 0x45, 0x56, 0x67, 0x00, 0x04, 0x78,
                  0x00, 0x02, 0x05, 0x01, 0x04, 0x78, 0x00, 0x00, 0x09, 0x1e, 0x00, 0x01});
    const Indices top{1, 14, 1, 14, 1, 14, 1, 14, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const Indices middle{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 7, 8, 7, 8};
    const Indices bottom{0, 4, 0, 0, 6, 0, 6, 0, 4, 5, 5, 6, 6, 7, 7, 8, 7, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    Indices all = top;
    all.insert(all.end(), middle.begin(), middle.end());
    all.insert(all.end(), bottom.begin(), bottom.end());
    EXPECT_EQ(indices_of(codes_bmp(27, 3, 4, codes)), all);
}

/// A row in runs and literal pixels of any length that may be.
std::string coded(const Indices& row, int bits, std::mt19937& random) {
    std::string codes;
    const auto packed = [&](std::size_t from, std::size_t count) {
        std::string bytes;
        for (std::size_t n = from; n < from + count; n += bits == 8 ? 1 : 2) {
            const int low = n + 1 < from + count ? row[n + 1] : 0;
            bytes.push_back(static_cast<char>(bits == 8 ? row[n] : row[n] * 16 + low));
        }
        return bytes;
    };
    for (std::size_t x = 0; x < row.size();) {
        std::size_t same = 1;
        while (x + same < row.size() && same < 255 && row[x + same] == row[x]) {
            ++same;
        }
        const std::size_t literal = std::min<std::size_t>(row.size() - x, 3 + random() % 20);
        if (same < 3 && literal >= 3) {
            codes += of_bytes({0, static_cast<int>(literal)}) + packed(x, literal);
            codes += codes.size() % 2 == 0 ? "" : std::string(1, '\0');
            x += literal;
        } else {
            codes += of_bytes({static_cast<int>(same), bits == 8 ? row[x] : row[x] * 17});
            x += same;
        }
    }
    return codes + of_bytes({0, 0});
}

TEST(BmpRuns, AreReadAsTheSamePixelsWithoutRuns) {
    std::mt19937 random(8);
    for (int turn = 0; turn < 200; ++turn) {
        const int bits = turn % 2 == 0 ? 8 : 4;
        const int width = 1 + static_cast<int>(random() % 400);
        const int height = 1 + static_cast<int>(random() % 6);
        Indices all;
        std::string codes;
        std::string plain;
        for (int y = 0; y < height; ++y) {
            Indices row;
            while (std::ssize(row) < width) {
                const auto index = static_cast<unsigned char>(random() % (1U << static_cast<unsigned>(bits)));
                row.insert(row.end(), 1 + random() % 9 * (random() % 40), index);
            }
            row.resize(static_cast<std::size_t>(width));
            codes += coded(row, bits, random);
            for (std::size_t x = 0; x < row.size(); x += bits == 8 ? 1 : 2) {
                const int low = x + 1 < row.size() ? row[x + 1] : 0;
                plain.push_back(static_cast<char>(bits == 8 ? row[x] : row[x] * 16 + low));
            }
            plain.resize((plain.size() + 3) / 4 * 4);
        }
        EXPECT_EQ(indices_of(codes_bmp(width, height, bits, codes + of_bytes({0, 1}))),
                  indices_of(bmp(width, height, bits, 0, plain)))
            << width << " x " << height << ", " << bits << " bits";
    }
}

TEST(BmpRuns, JumpOverRowsAndEndBeforeTheTop) {
    // One pixel, then two columns right and three rows up; the rows above have none.
    const std::string codes = of_bytes({1, 9, 0, 2, 2, 3, 1, 7, 0, 1});
    const Indices all{0, 0, 0, 0, /**/ 0, 0, 0, 7, /**/ 0, 0, 0, 0, /**/ 0, 0, 0, 0, /**/ 9, 0, 0, 0};
    EXPECT_EQ(indices_of(codes_bmp(4, 5, 8, codes)), all);
}

TEST(BmpRuns, SayWhereTheyAreWrong) {
    EXPECT_THAT(bmp_error(codes_bmp(4, 2, 8, of_bytes({4, 1, 0, 0, 5, 1, 0, 1}))),
                HasSubstr("the run at byte 1082 of the BMP ends at column 5, beyond the width of 4"));
    EXPECT_THAT(bmp_error(codes_bmp(4, 2, 8, of_bytes({0, 5, 1, 2, 3, 4, 5, 0}))),
                HasSubstr("ends at column 5, beyond the width of 4"));
    EXPECT_THAT(bmp_error(codes_bmp(4, 2, 8, of_bytes({0, 2, 9, 0}))),
                HasSubstr("ends at column 9, beyond the width of 4"));
    EXPECT_THAT(bmp_error(codes_bmp(4, 2, 8, of_bytes({4, 1, 0, 0, 3}))),
                HasSubstr("the BMP is cut off at byte 1083, before the end code"));
    EXPECT_THAT(bmp_error(codes_bmp(4, -2, 8, of_bytes({4, 1, 0, 1}))), HasSubstr("stored top-down"));
    EXPECT_THAT(bmp_error(codes_bmp(30'000, 30'000, 8, of_bytes({0, 1}))),
                HasSubstr("is too small for the 30000 x 30000 pixels in its header"));
}

} // namespace
} // namespace millwright::plot
