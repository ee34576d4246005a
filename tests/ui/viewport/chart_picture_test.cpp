#include "ui/viewport/chart_picture.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace millwright::viewport {
namespace {

Chart chart(double last) {
    return {"error", "points", "error", "mm", true, {{"uniform", {10, 20, 30}, {3.0, 1.0, last}}}};
}

std::size_t different_pixels(const render::Picture& a, const render::Picture& b) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.pixels.size(); ++n) {
        count += a.pixels[n] == b.pixels[n] ? 0U : 1U;
    }
    return count;
}

TEST(ChartPicture, ShowsItsNumbers) {
    const render::PixelSize size{400, 300};
    const auto one = chart_picture({chart(0.3)}, size, render::Theme::light);
    const auto same = chart_picture({chart(0.3)}, size, render::Theme::light);
    const auto other = chart_picture({chart(0.1)}, size, render::Theme::light);
    EXPECT_EQ(one.size.width, 400);
    EXPECT_EQ(one, same);
    EXPECT_GT(different_pixels(one, other), 50U);
}

TEST(ChartPicture, LeavesItsMarginFree) {
    const auto picture = chart_picture({chart(0.3), chart(0.1)}, {400, 500}, render::Theme::light);
    for (int y = 0; y < 500; ++y) {
        for (const int x : {0, 10, 390, 399}) {
            EXPECT_EQ(picture.at(x, y), picture.at(0, 0)) << x << " " << y;
        }
    }
}

TEST(ChartPicture, NeedsAChart) {
    EXPECT_THROW((void)chart_picture({}, {100, 100}, render::Theme::light), Defect);
}

} // namespace
} // namespace millwright::viewport
