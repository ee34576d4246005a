// How cameras lay pictures down, against the words of Exif 2.3: each orientation names the sides of the seen
// picture on which the file's first row and first column lie.
#include "core/plot/picture/picture.h"
#include "tests/core/plot/picture/made_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace millwright::plot {
namespace {

enum class Side { top, bottom, left, right };

struct Orientation {
    Side row;    ///< of the file's first row
    Side column; ///< of its first column
};

constexpr std::array<Orientation, 8> orientations{{{Side::top, Side::left},
                                                   {Side::top, Side::right},
                                                   {Side::bottom, Side::right},
                                                   {Side::bottom, Side::left},
                                                   {Side::left, Side::top},
                                                   {Side::right, Side::top},
                                                   {Side::right, Side::bottom},
                                                   {Side::left, Side::bottom}}};

/// Behind the first marker of `jpeg`.
std::string with_orientation(const std::string& jpeg, int orientation, bool little) {
    const auto two = [&](int value) {
        const char high = static_cast<char>(value >> 8);
        const char low = static_cast<char>(value & 0xFF);
        return little ? std::string{low, high} : std::string{high, low};
    };
    const auto four = [&](int value) { return little ? two(value) + two(0) : two(0) + two(value); };
    const std::string tiff = (little ? "II" : "MM") + two(42) + four(8) + two(1) + two(0x0112) + two(3) +
                             four(1) + two(orientation) + two(0) + four(0);
    const std::string body = std::string("Exif\0\0", 6) + tiff;
    const auto length = static_cast<int>(body.size()) + 2;
    const std::string segment =
        std::string("\xFF\xE1", 2) + static_cast<char>(length >> 8) + static_cast<char>(length & 0xFF) + body;
    return jpeg.substr(0, 2) + segment + jpeg.substr(2);
}

constexpr int exif_columns = 40;
constexpr int exif_rows = 24;

/// Squares of eight pixels in grays of their own, which JPEG keeps.
std::string checkered() {
    Samples samples{exif_columns, exif_rows, 1, {}};
    for (int y = 0; y < exif_rows; ++y) {
        for (int x = 0; x < exif_columns; ++x) {
            samples.values.push_back(static_cast<std::uint16_t>(16 * (x / 8 + 5 * (y / 8))));
        }
    }
    return jpeg_of(samples);
}

TEST(ExifOrientation, LaysPicturesDownAsTheyWereSeen) {
    const std::string jpeg = checkered();
    const Picture file = read_picture(jpeg, "test").picture;
    for (int n = 1; n <= 8; ++n) {
        for (const bool little : {true, false}) {
            const Picture seen = read_picture(with_orientation(jpeg, n, little), "test").picture;
            const Orientation& is = orientations[static_cast<std::size_t>(n - 1)];
            const bool lies = is.row == Side::left || is.row == Side::right;
            ASSERT_EQ(seen.width, lies ? exif_rows : exif_columns) << n;
            ASSERT_EQ(seen.height, lies ? exif_columns : exif_rows) << n;
            for (int r = 0; r < exif_rows; ++r) {
                for (int c = 0; c < exif_columns; ++c) {
                    int x = 0;
                    int y = 0;
                    const auto put = [&](Side side, int from_it) {
                        x = side == Side::left ? from_it : side == Side::right ? seen.width - 1 - from_it : x;
                        y = side == Side::top      ? from_it
                            : side == Side::bottom ? seen.height - 1 - from_it
                                                   : y;
                    };
                    put(is.row, r);
                    put(is.column, c);
                    ASSERT_EQ(seen.at(y, x), file.at(r, c)) << n;
                }
            }
        }
    }
}

TEST(ExifOrientation, RegionsAreThoseOfThePictureThatIsSeen) {
    const std::string jpeg = checkered();
    for (int n = 1; n <= 8; ++n) {
        const std::string turned = with_orientation(jpeg, n, true);
        const Picture whole = read_picture(turned, "test").picture;
        PictureSettings settings;
        settings.region = {3, 5, 13, 11};
        const Picture part = read_picture(turned, "test", settings).picture;
        settings.region = {3, 5, 0, 0}; // up to the edges of what is seen
        const Picture rest = read_picture(turned, "test", settings).picture;
        ASSERT_EQ(rest.width, whole.width - 3) << n;
        ASSERT_EQ(rest.height, whole.height - 5) << n;
        EXPECT_EQ(rest.at(rest.height - 1, rest.width - 1), whole.at(whole.height - 1, whole.width - 1)) << n;
        ASSERT_EQ(part.width, 13) << n;
        ASSERT_EQ(part.height, 11) << n;
        for (int y = 0; y < 11; ++y) {
            for (int x = 0; x < 13; ++x) {
                ASSERT_EQ(part.at(y, x), whole.at(y + 5, x + 3)) << n;
            }
        }
    }
}

TEST(ExifOrientation, ThatIsNoneIsPassedOver) {
    const std::string jpeg = checkered();
    const Picture plain = read_picture(jpeg, "test").picture;
    for (const int orientation : {0, 9, 255}) {
        EXPECT_EQ(read_picture(with_orientation(jpeg, orientation, true), "test").picture, plain);
    }
    for (const std::string& damaged : {std::string("Exif\0\0", 6),
                                       std::string("Exif\0\0II*\0\xFF\xFF\xFF\xFF", 14),
                                       std::string("other")}) {
        const auto length = static_cast<char>(damaged.size() + 2);
        const std::string bytes =
            jpeg.substr(0, 2) + std::string("\xFF\xE1\0", 3) + length + damaged + jpeg.substr(2);
        EXPECT_EQ(read_picture(bytes, "test").picture, plain);
    }
}

} // namespace
} // namespace millwright::plot
