// What we read is compared with what stb_image, another decoder, reads from the same bytes.
#include "core/plot/picture/picture.h"

#include "core/base/files.h"
#include "tests/core/plot/picture/made_pictures.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb_image.h>

#include <cstdlib>
#include <functional>
#include <memory>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

Picture picture_of(const std::string& bytes, const PictureSettings& settings = {}) {
    return read_picture(bytes, "test", settings).picture;
}

using Rule = std::function<std::uint32_t(std::uint32_t, std::uint32_t, std::uint32_t)>;

std::uint32_t mean(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    return (r + g + b) / 3;
}

/// The picture as stb_image and `rule` have it, of 16 bits per sample.
Picture by_stb(const std::string& bytes, bool wide, const Rule& rule) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    Picture picture;
    int channels = 0;
    const auto add = [&](const auto* pixels, std::uint32_t scale) {
        for (int n = 0; n < picture.width * picture.height; ++n) {
            const auto* p = pixels + std::ptrdiff_t{3} * n;
            picture.gray.push_back(static_cast<std::uint16_t>(rule(p[0], p[1], p[2]) * scale));
        }
    };
    if (wide) {
        const std::unique_ptr<stbi_us, decltype(&std::free)> pixels(
            stbi_load_16_from_memory(data, size, &picture.width, &picture.height, &channels, 3), &std::free);
        add(pixels.get(), 1);
    } else {
        const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
            stbi_load_from_memory(data, size, &picture.width, &picture.height, &channels, 3), &std::free);
        add(pixels.get(), 257);
    }
    return picture;
}

int largest_difference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    int most = a.gray.size() == b.gray.size() ? 0 : 1 << 20;
    for (std::size_t n = 0; n < std::min(a.gray.size(), b.gray.size()); ++n) {
        most = std::max(most, std::abs(int{a.gray[n]} - int{b.gray[n]}));
    }
    return most;
}

std::string picture_error(const std::string& bytes, const PictureSettings& settings = {}) {
    try {
        static_cast<void>(read_picture(bytes, "bad.png", settings));
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "no error";
}

/// One pixel of these colours.
std::string pixel(std::uint16_t r, std::uint16_t g, std::uint16_t b) {
    return png_of({1, 1, 3, {r, g, b}});
}

TEST(PictureReader, TakesTheGrayRuleOfTheThesis) {
    EXPECT_EQ(picture_of(pixel(255, 255, 255)).at(0, 0), 255 * 257);
    EXPECT_EQ(picture_of(pixel(0, 0, 0)).at(0, 0), 0);
    EXPECT_EQ(picture_of(pixel(255, 0, 0)).at(0, 0), 85 * 257);
    EXPECT_EQ(picture_of(pixel(0, 255, 0)).at(0, 0), 85 * 257);
    EXPECT_EQ(picture_of(pixel(0, 0, 255)).at(0, 0), 85 * 257);
    EXPECT_EQ(picture_of(pixel(10, 20, 31)).at(0, 0), 20 * 257); // 20.33 cut off
}

TEST(PictureReader, WeighsColoursAsTheEyeDoesWhereAsked) {
    const PictureSettings settings{.gray = GrayRule::luminance};
    EXPECT_EQ(picture_of(pixel(255, 255, 255), settings).at(0, 0), white);
    EXPECT_NEAR(picture_of(pixel(255, 0, 0), settings).at(0, 0), 0.2126 * white, 1.0);
    EXPECT_NEAR(picture_of(pixel(0, 255, 0), settings).at(0, 0), 0.7152 * white, 1.0);
    EXPECT_NEAR(picture_of(pixel(0, 0, 255), settings).at(0, 0), 0.0722 * white, 1.0);
}

TEST(PictureReader, Inverts) {
    EXPECT_EQ(picture_of(pixel(30, 30, 30), {.invert = true}).at(0, 0), (255 - 30) * 257);
}

TEST(PictureReader, ReadsColourPngAsStbDoes) {
    for (const bool interlaced : {false, true}) {
        const std::string bytes = png_of(noise(37, 23, 3, 8), {.interlaced = interlaced});
        EXPECT_EQ(picture_of(bytes), by_stb(bytes, false, mean));
    }
}

TEST(PictureReader, KeepsThe16BitsOfAPng) {
    for (const int channels : {1, 3}) {
        const std::string bytes = png_of(noise(19, 11, channels, 16), {.bits = 16});
        EXPECT_EQ(picture_of(bytes), by_stb(bytes, true, mean));
    }
}

TEST(PictureReader, ReadsPalettesAndFewBitsAsStbDoes) {
    for (const int bits : {1, 2, 4, 8}) {
        for (const bool palette : {false, true}) {
            const std::string bytes = png_of(noise(29, 7, 1, bits), {.bits = bits, .palette = palette});
            EXPECT_EQ(picture_of(bytes), by_stb(bytes, false, mean)) << bits << ' ' << palette;
        }
    }
}

TEST(PictureReader, PutsTransparentPixelsOnWhite) {
    const ReadPicture read = read_picture(png_of({3, 1, 4, {0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 51}}), "test");
    EXPECT_EQ(read.picture.gray, (std::vector<std::uint16_t>{white, 0, 204 * 257}));
    ASSERT_EQ(read.notices.size(), 1U);
    EXPECT_THAT(read.notices[0].message, HasSubstr("transparent pixels are not cut"));
}

TEST(PictureReader, ReadsJpegAsStbDoes) {
    for (const int channels : {1, 3}) {
        for (const bool progressive : {false, true}) {
            const std::string bytes = jpeg_of(noise(40, 33, channels, 8), {.progressive = progressive});
            constexpr int steps = 4; // decoders may round their transforms differently, chroma is upsampled
            EXPECT_LE(largest_difference(picture_of(bytes), by_stb(bytes, false, mean)), steps * 257);
        }
    }
}

// Paper without ink is white, black ink is black, half of each colour is gray; both ways of storing it.
TEST(PictureReader, MixesFourInks) {
    for (const bool adobe : {false, true}) {
        Samples inks{16, 8, 4, {}};
        for (int n = 0; n < 16 * 8; ++n) {
            const int x = n % 16;
            const std::uint16_t color = x < 8 ? 0 : 128;
            const std::uint16_t black = n / 16 < 4 ? 0 : 255;
            for (const std::uint16_t ink : {color, color, color, black}) {
                inks.values.push_back(static_cast<std::uint16_t>(adobe ? 255 - ink : ink));
            }
        }
        const ReadPicture read = read_picture(jpeg_of(inks, {.adobe = adobe}), "test");
        EXPECT_NEAR(read.picture.at(0, 2), 255 * 257, 6 * 257);
        EXPECT_NEAR(read.picture.at(0, 13), 127 * 257, 6 * 257);
        EXPECT_NEAR(read.picture.at(7, 2), 0, 6 * 257);
        ASSERT_EQ(read.notices.size(), 1U);
        EXPECT_THAT(read.notices[0].message, HasSubstr("CMYK"));
    }
}

TEST(PictureReader, ReadsBmpAsStbDoes) {
    for (const int bits : {24, 32}) {
        for (const bool top_down : {false, true}) {
            const std::string bytes = bmp_of(noise(21, 9, 3, 8), bits, top_down);
            EXPECT_EQ(picture_of(bytes), by_stb(bytes, false, mean)) << bits;
        }
    }
}

/// Of so many channels, with samples up to `most`.
std::string pnm_of(const Samples& samples, int most, const std::string& comment = "") {
    std::string bytes = samples.channels == 3 ? "P6" : "P5";
    bytes += "\n" + comment + std::to_string(samples.width) + " " + std::to_string(samples.height) + "\n" +
             std::to_string(most) + "\n";
    for (const std::uint16_t value : samples.values) {
        if (most > 255) {
            bytes += static_cast<char>(value >> 8U);
        }
        bytes += static_cast<char>(value);
    }
    return bytes;
}

TEST(PictureReader, ReadsPgmAndPpmAsStbDoes) {
    const std::string colours = pnm_of(noise(7, 5, 3, 8), 255, "# a comment of 9 9\n");
    EXPECT_EQ(picture_of(colours), by_stb(colours, false, mean));
    const std::string gray = pnm_of(noise(7, 5, 1, 8), 255);
    EXPECT_EQ(picture_of(gray), by_stb(gray, false, mean));
    const Samples wide = noise(7, 5, 1, 16);
    EXPECT_EQ(picture_of(pnm_of(wide, 65535)).gray, wide.values);
    const Picture of_ten = picture_of(pnm_of({3, 1, 1, {0, 5, 10}}, 10));
    EXPECT_EQ(of_ten.gray, (std::vector<std::uint16_t>{0, 32768, 65535}));
}

TEST(PictureReader, SaysWhatIsWrongInAPnm) {
    EXPECT_THAT(picture_error("P5"), HasSubstr("the PNM has no width at byte 2"));
    EXPECT_THAT(picture_error("P5 3 # no more"), HasSubstr("the PNM has no height"));
    EXPECT_THAT(picture_error("P5 3 2 70000\n"), HasSubstr("a largest value of 70000"));
    EXPECT_THAT(picture_error("P6 2 2 255\n12345678901"),
                HasSubstr("cut off: it has 22 bytes, but its size needs 23"));
    EXPECT_THAT(picture_error("P5 99999999999 2 255\n"), HasSubstr("is too large"));
    EXPECT_THAT(picture_error(pnm_of({1, 1, 1, {11}}, 10)),
                HasSubstr("a sample of 11, above its largest value"));
}

TEST(PictureReader, TakesTheRegionAlone) {
    const Samples samples = noise(20, 16, 1, 8);
    const Picture all = picture_of(png_of(samples));
    for (const std::string& bytes : {png_of(samples), png_of(samples, {.interlaced = true})}) {
        const Picture part = picture_of(bytes, {.region = PixelRegion{3, 5, 7, 4}});
        ASSERT_EQ(part.width, 7);
        ASSERT_EQ(part.height, 4);
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 7; ++column) {
                EXPECT_EQ(part.at(row, column), all.at(row + 5, column + 3));
            }
        }
    }
    const Picture rest = picture_of(png_of(samples), {.region = PixelRegion{3, 5, 0, 0}}); // up to the edges
    ASSERT_EQ(rest.width, 17);
    ASSERT_EQ(rest.height, 11);
    EXPECT_EQ(rest.at(10, 16), all.at(15, 19));
    EXPECT_THAT(picture_error(png_of(samples), {.region = PixelRegion{20, 0, 0, 0}}),
                HasSubstr("the region of 0 x 16 pixels from (20, 0) extends beyond the picture of 20 x 16"));
    EXPECT_THAT(picture_error(png_of(samples), {.region = PixelRegion{15, 0, 6, 1}}),
                HasSubstr("the region of 6 x 1 pixels from (15, 0) extends beyond the picture of 20 x 16"));
}

TEST(PictureReader, SaysHowManyPixelsAMillimetreHas) {
    EXPECT_DOUBLE_EQ(picture_of(png_of(noise(2, 2, 1, 8), {.pixels_per_metre = 3937})).pixels_per_mm.value(),
                     3.937);
    EXPECT_DOUBLE_EQ(picture_of(jpeg_of(noise(8, 8, 1, 8), {.dots_per_inch = 254})).pixels_per_mm.value(),
                     10.0);
    EXPECT_EQ(picture_of(png_of(noise(2, 2, 1, 8))).pixels_per_mm, std::nullopt);
}

TEST(PictureReader, AveragesWhatIsTooLarge) {
    const Samples samples = noise(10, 7, 1, 8);
    const std::vector<std::string> files = {png_of(samples), bmp_of(noise(10, 7, 3, 8), 24, false)};
    for (const std::string& bytes : files) {
        const Picture all = picture_of(bytes);
        const ReadPicture read = read_picture(bytes, "test", {.most_pixels = 12});
        ASSERT_EQ(read.picture.width, 4); // squares of 3
        ASSERT_EQ(read.picture.height, 3);
        EXPECT_EQ(read.picture.file_pixels, 3);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                double sum = 0.0;
                int count = 0;
                for (int y = 3 * row; y < std::min(3 * row + 3, 7); ++y) {
                    for (int x = 3 * column; x < std::min(3 * column + 3, 10); ++x, ++count) {
                        sum += all.at(y, x);
                    }
                }
                EXPECT_NEAR(read.picture.at(row, column), sum / count, 0.5);
            }
        }
        ASSERT_EQ(read.notices.size(), 1U);
        EXPECT_THAT(read.notices[0].message, HasSubstr("10 x 7 pixels are averaged over squares of 3"));
    }
}

/// The head of a BMP of one bit per pixel, black and white.
std::string bit_map_head(std::uint32_t width, std::uint32_t height) {
    std::string bytes = bmp_of({1, 1, 3, {0, 0, 0}}, 24, false).substr(0, 54);
    const auto set = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t n = 0; n < 4; ++n) {
            bytes[at + n] = static_cast<char>(value >> (8 * n));
        }
    };
    set(10, 62);
    set(18, width);
    set(22, height);
    set(26, 1 + (1U << 16U)); // planes, bits
    return bytes + std::string(4, '\0') + std::string(4, '\xff');
}

// The rows are a hole in the file, so that it takes no room.
TEST(PictureReader, AveragesAStripOf30000By30000Pixels) {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "huge.bmp";
    constexpr std::uint32_t side = 30'000;
    write_file(file, bit_map_head(side, side));
    std::filesystem::resize_file(file, 62 + std::uintmax_t{side} * ((side + 31) / 32 * 4));
    const ReadPicture read =
        read_picture_file(file, {.region = PixelRegion{0, 29'500, 30'000, 500}, .most_pixels = 1'000'000});
    EXPECT_EQ(read.picture.width, 7500);
    EXPECT_EQ(read.picture.height, 125);
    EXPECT_EQ(std::ranges::count(read.picture.gray, 0), 7500 * 125);
}

TEST(PictureReader, SaysWhatIsWrong) {
    const std::string png = png_of(noise(20, 20, 3, 8));
    const std::string jpeg = jpeg_of(noise(40, 40, 3, 8));
    const std::string bmp = bmp_of(noise(20, 20, 3, 8), 24, false);
    EXPECT_THAT(picture_error(""), HasSubstr("bad.png: the file is empty"));
    EXPECT_THAT(picture_error("GIF89a"),
                HasSubstr("the picture format is not supported (use a PNG, JPEG, BMP, PGM or PPM"));
    EXPECT_THAT(picture_error(png.substr(0, 12)),
                HasSubstr("the PNG ends too early, after 12 bytes: its header is incomplete"));
    EXPECT_THAT(picture_error(png.substr(0, png.size() / 2)), HasSubstr("the PNG ends too early, after"));
    EXPECT_THAT(picture_error(jpeg.substr(0, 30)), HasSubstr("the JPEG cannot be read at its header"));
    EXPECT_THAT(picture_error(jpeg.substr(0, jpeg.size() / 2)), HasSubstr("the JPEG cannot be read at row"));
    EXPECT_THAT(picture_error(bmp.substr(0, 20)), HasSubstr("the BMP is cut off at byte 20"));
    EXPECT_THAT(picture_error(bmp.substr(0, 100)),
                HasSubstr("the BMP is cut off: it has 100 bytes, but its size needs 1254"));
    std::string flipped = png;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
    EXPECT_THAT(picture_error(flipped), HasSubstr("the PNG is damaged at row"));
    std::string compressed = bmp;
    compressed[30] = 1;
    EXPECT_THAT(picture_error(compressed),
                HasSubstr("the BMP's pixels of 24 bits use an unsupported compression (type 1) (save it "
                          "uncompressed, or as PNG)"));
    std::string flat = bmp;
    flat[18] = 0;
    EXPECT_THAT(picture_error(flat), HasSubstr("a picture of 0 x 20 pixels is not possible"));
    std::string huge = bmp;
    huge[21] = 0x7f;
    EXPECT_THAT(picture_error(huge), HasSubstr("is too large"));
}

TEST(PictureReader, RefusesWhatNeedsTooMuchMemoryAtOnce) {
    const PictureSettings small{.most_memory = 1000};
    EXPECT_THAT(picture_error(png_of(noise(40, 40, 1, 8), {.interlaced = true}), small),
                HasSubstr("an interlaced PNG of this size needs"));
    EXPECT_THAT(picture_error(jpeg_of(noise(40, 40, 3, 8), {.progressive = true}), small),
                HasSubstr("a progressive JPEG of this size needs"));
    EXPECT_EQ(picture_of(png_of(noise(40, 40, 1, 8)), small).width, 40);
}

TEST(PictureReader, IsCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(static_cast<void>(read_picture(pixel(1, 2, 3), "test", {}, Progress({}, stop.get_token()))),
                 Cancelled);
}

TEST(PngWriter, IsReadBackAsItWas) {
    const GrayImage image{3, 2, {0, 50, 100, 150, 200, 255}};
    const Picture picture = picture_of(png_bytes(image));
    EXPECT_EQ(picture.width, 3);
    for (std::size_t n = 0; n < image.pixels.size(); ++n) {
        EXPECT_EQ(picture.gray[n], image.pixels[n] * 257);
    }
    EXPECT_EQ(by_stb(png_bytes(image), false, mean), picture);
}

} // namespace
} // namespace millwright::plot
