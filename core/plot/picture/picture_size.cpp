#include "core/plot/picture/picture_size.h"

#include "core/plot/picture/internal/checks.h"

namespace millwright::plot {

double pixel_pitch(const PictureSize& size, const Picture& picture) {
    constexpr double mm_per_inch = 25.4;
    constexpr double thesis_pixel = 0.26;
    if (size.width) {
        internal::check_above_zero("the width", *size.width);
        return *size.width / picture.width;
    }
    if (size.dots_per_inch) {
        internal::check_above_zero("the number of pixels per inch", *size.dots_per_inch);
        return picture.file_pixels * mm_per_inch / *size.dots_per_inch;
    }
    if (size.pixel) {
        internal::check_above_zero("the pixel width", *size.pixel);
        return picture.file_pixels * *size.pixel;
    }
    return picture.pixels_per_mm ? 1.0 / *picture.pixels_per_mm : picture.file_pixels * thesis_pixel;
}

} // namespace millwright::plot
