// Pictures whose pixels are not square, that a camera turned, or that let the ground through.
#include "core/plot/picture/height_field.h"
#include "core/plot/picture/picture.h"
#include "tests/core/plot/picture/made_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

/// Rows of 0, 40, 80 ...: easy to tell after they were averaged.
Samples stripes(int width, int height) {
    Samples samples{width, height, 1, {}};
    for (int n = 0; n < width * height; ++n) {
        samples.values.push_back(static_cast<std::uint16_t>(40 * (n / width)));
    }
    return samples;
}

void expect_rows(const Picture& picture, const std::vector<int>& grays) {
    ASSERT_EQ(picture.height, static_cast<int>(grays.size()));
    for (int row = 0; row < picture.height; ++row) {
        EXPECT_EQ(picture.at(row, 0), grays[static_cast<std::size_t>(row)] * 257) << row;
    }
}

// Half as many pixels per millimetre down as across: each row is two.
TEST(PixelShape, PixelsOfEveryFormatBecomeSquare) {
    const std::string png = png_of(stripes(6, 4), {.pixels_per_metre = 10'000, .rows_per_metre = 5'000});
    const ReadPicture read = read_picture(png, "a.png");
    EXPECT_EQ(read.picture.width, 6);
    expect_rows(read.picture, {0, 0, 40, 40, 80, 80, 120, 120});
    EXPECT_DOUBLE_EQ(read.picture.pixels_per_mm.value(), 10.0);
    EXPECT_DOUBLE_EQ(pixel_pitch({}, read.picture) * read.picture.height, 0.8); // 4 rows of 0.2 mm
    ASSERT_EQ(read.notices.size(), 1U);
    EXPECT_THAT(read.notices.front().message, HasSubstr("4 rows become 8 rows of square pixels"));

    const std::string flat = png_of(stripes(6, 4), {.pixels_per_metre = 5'000, .rows_per_metre = 10'000});
    expect_rows(read_picture(flat, "a.png").picture, {20, 100});

    Samples colours{6, 4, 3, {}};
    for (const std::uint16_t gray : stripes(6, 4).values) {
        colours.values.insert(colours.values.end(), 3, gray);
    }
    std::string bmp = bmp_of(colours, 24, false);
    const auto put = [&](std::size_t at, std::uint32_t value) {
        std::string bytes;
        append_little_endian(bytes, value, 4);
        bmp.replace(at, 4, bytes);
    };
    put(38, 10'000);
    put(42, 5'000);
    expect_rows(read_picture(bmp, "a.bmp").picture, {0, 0, 40, 40, 80, 80, 120, 120});

    const std::string jpeg = jpeg_of(stripes(8, 16), {.dots_per_inch = 300, .rows_per_inch = 150});
    EXPECT_EQ(read_picture(jpeg, "a.jpg").picture.height, 32);
}

TEST(PixelShape, AFileMaySayTheShapeAlone) {
    const std::string png =
        png_of(stripes(6, 4), {.pixels_per_metre = 2, .rows_per_metre = 1, .in_metres = false});
    const Picture picture = read_picture(png, "a.png").picture;
    EXPECT_EQ(picture.height, 8);
    EXPECT_EQ(picture.pixels_per_mm, std::nullopt);
    // Whole numbers of pixels per metre are never quite alike, and a hundredfold shape is a damaged number.
    EXPECT_EQ(
        read_picture(png_of(stripes(6, 4), {.pixels_per_metre = 11811, .rows_per_metre = 11812}), "a.png")
            .picture.height,
        4);
    EXPECT_EQ(
        read_picture(png_of(stripes(6, 4), {.pixels_per_metre = 10'000, .rows_per_metre = 100}), "a.png")
            .picture.height,
        4);
}

/// A chunk with no check sum that anybody looks at, behind the head of `png`.
std::string with_exif(const std::string& png, int orientation) {
    std::string tiff("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19);
    tiff += static_cast<char>(orientation);
    tiff += std::string(6, '\0');
    constexpr std::size_t behind_head = 8 + 25;
    return png.substr(0, behind_head) + std::string("\0\0\0\x1A", 4) + "eXIf" + tiff +
           std::string("\0\0\0\0", 4) + png.substr(behind_head);
}

TEST(PixelShape, APngIsTurnedAsItsExifSays) {
    const std::string png = png_of(stripes(6, 4));
    const Picture seen = read_picture(with_exif(png, 6), "a.png").picture; // a quarter clockwise
    ASSERT_EQ(seen.width, 4);
    ASSERT_EQ(seen.height, 6);
    EXPECT_EQ(seen.at(0, 0), 120 * 257); // the file's lowest row is at the left
    EXPECT_EQ(seen.at(0, 3), 0);
    const Picture part =
        read_picture(with_exif(png, 6), "a.png", {.region = PixelRegion{0, 0, 1, 6}}).picture;
    ASSERT_EQ(part.width, 1);
    ASSERT_EQ(part.height, 6);
    EXPECT_EQ(part.at(5, 0), 120 * 257);
    EXPECT_EQ(read_picture(with_exif(png, 9), "a.png").picture.width, 6); // no orientation
}

// A white logo on a transparent ground: both were white, so that none of it could be engraved.
TEST(TransparentGround, IsNotCutWhetherThePictureIsInvertedOrNot) {
    const Samples logo{3, 1, 4, {255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 255}}; // white, none, black
    const auto grays = [&](const PictureSettings& settings) {
        return read_picture(png_of(logo), "logo.png", settings).picture.gray;
    };
    EXPECT_EQ(grays({}), (std::vector<std::uint16_t>{white, white, 0}));
    EXPECT_EQ(grays({.invert = true}), (std::vector<std::uint16_t>{0, white, white}));
    // Of a relief what stays at the top is black.
    EXPECT_EQ(grays({.ground = relief_top}), (std::vector<std::uint16_t>{white, 0, 0}));
    const Picture inverted =
        read_picture(png_of(logo), "logo.png", {.invert = true, .ground = relief_top}).picture;
    EXPECT_EQ(inverted.gray, (std::vector<std::uint16_t>{0, 0, white}));
    EXPECT_FLOAT_EQ(height_field(inverted, 1.0, 2.0).z[1], 0.0F);
}

TEST(PixelShape, CellsAreAsHighAsAPersonSays) {
    const std::string png = png_of(stripes(6, 4));
    const Picture high = read_picture(png, "a.png", {.pixel_aspect = 2.0}).picture;
    EXPECT_EQ(high.width, 6);
    expect_rows(high, {0, 0, 40, 40, 80, 80, 120, 120});
    expect_rows(read_picture(png, "a.png", {.pixel_aspect = 0.5}).picture, {20, 100});
    EXPECT_THROW((void)read_picture(png, "a.png", {.pixel_aspect = 0.0}), Error);
}

TEST(GraySteps, AreBandsOfEqualWidthFromBlackToWhite) {
    Samples samples{256, 1, 1, {}};
    for (std::uint16_t gray = 0; gray < 256; ++gray) {
        samples.values.push_back(gray);
    }
    const std::string png = png_of(samples);
    for (const int steps : {2, 8, 16, 256}) {
        const Picture picture = read_picture(png, "a.png", {.gray_steps = steps}).picture;
        for (int gray = 0; gray < 256; ++gray) {
            const int band = gray * steps / 256;
            EXPECT_NEAR(picture.at(0, gray), 65535.0 * band / (steps - 1), 1.0) << steps << " " << gray;
        }
    }
    EXPECT_THROW((void)read_picture(png, "a.png", {.gray_steps = 1}), Error);
    EXPECT_THROW((void)read_picture(png, "a.png", {.gray_steps = 257}), Error);
}

} // namespace
} // namespace millwright::plot
