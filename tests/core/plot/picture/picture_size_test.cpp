#include "core/plot/picture/picture.h"

#include <gtest/gtest.h>

#include <optional>

namespace millwright::plot {
namespace {

Picture picture(int width, int file_pixels, std::optional<double> pixels_per_mm) {
    Picture made;
    made.width = width;
    made.height = 1;
    made.pixels_per_mm = pixels_per_mm;
    made.file_pixels = file_pixels;
    return made;
}

TEST(PictureSize, IsWhatIsGivenElseTheFilesElseThatOfTheThesis) {
    const Picture plain = picture(500, 1, std::nullopt);
    EXPECT_DOUBLE_EQ(pixel_pitch({.width = 100.0}, plain), 0.2);
    EXPECT_DOUBLE_EQ(pixel_pitch({.dots_per_inch = 254.0}, plain), 0.1);
    EXPECT_DOUBLE_EQ(pixel_pitch({.pixel = 0.05}, plain), 0.05);
    EXPECT_DOUBLE_EQ(pixel_pitch({}, plain), 0.26);
    EXPECT_DOUBLE_EQ(pixel_pitch({}, picture(500, 1, 8.0)), 0.125);
    EXPECT_DOUBLE_EQ(pixel_pitch({.width = 100.0, .dots_per_inch = 1.0, .pixel = 9.0}, plain), 0.2);
}

// 2000 pixels of the file, averaged over squares of 4: the work is as large as without.
TEST(PictureSize, OfAnAveragedPictureIsThatOfItsFile) {
    const Picture whole = picture(2000, 1, std::nullopt);
    const Picture averaged = picture(500, 4, std::nullopt);
    for (const PictureSize& size : {PictureSize{},
                                    PictureSize{.width = 300.0},
                                    PictureSize{.dots_per_inch = 300.0},
                                    PictureSize{.pixel = 0.1}}) {
        EXPECT_NEAR(
            averaged.width * pixel_pitch(size, averaged), whole.width * pixel_pitch(size, whole), 1e-9);
    }
}

TEST(PictureSize, RefusesWhatIsNone) {
    const Picture plain = picture(500, 1, std::nullopt);
    EXPECT_THROW(static_cast<void>(pixel_pitch({.width = 0.0}, plain)), Error);
    EXPECT_THROW(static_cast<void>(pixel_pitch({.dots_per_inch = -1.0}, plain)), Error);
    EXPECT_THROW(static_cast<void>(pixel_pitch({.pixel = 0.0}, plain)), Error);
}

} // namespace
} // namespace millwright::plot
