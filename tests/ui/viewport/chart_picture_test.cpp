#include "ui/viewport/chart_picture.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

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
    EXPECT_EQ(picture.at(0, 0), picture.at(375, 21)) << "beside the title: no panel whose edge it stands on";
}

/// Ten lines, of which one is drawn; the key is left out, since it is the same for all.
Chart one_of_ten(std::size_t drawn) {
    Chart ten{"error", "points", "error", "mm", true, std::vector<ChartLine>(10)};
    ten.lines[drawn] = {"", {10, 20, 30}, {3.0, 1.0, 2.0}};
    ten.shows_values = true;
    ten.has_key = false;
    return ten;
}

// There are six colours; the seventh of ten methods looked as the first.
TEST(ChartPicture, TenLinesLookDifferent) {
    const render::PixelSize size{300, 200};
    std::vector<render::Picture> pictures;
    for (std::size_t n = 0; n < 10; ++n) {
        pictures.push_back(chart_picture({one_of_ten(n)}, size, render::Theme::light));
        for (std::size_t other = 0; other < n; ++other) {
            EXPECT_GT(different_pixels(pictures[other], pictures[n]), 50U) << other << " " << n;
        }
    }
}

TEST(ChartPicture, ALongKeyStaysInside) {
    Chart ten{"error", "points", "error", "mm", true, std::vector<ChartLine>(10)};
    for (ChartLine& line : ten.lines) {
        line = {"set-up + chain", {10, 20, 30}, {3.0, 1.0, 2.0}};
    }
    const auto picture = chart_picture({ten}, {500, 300}, render::Theme::light);
    int dark = 0; // where letters were cut off at the left
    for (int y = 0; y < 300; ++y) {
        dark += picture.at(20, y) == picture.at(0, 0) ? 0 : 1;
    }
    ten.has_key = false;
    const auto without = chart_picture({ten}, {500, 300}, render::Theme::light);
    for (int y = 0; y < 300; ++y) {
        dark -= without.at(20, y) == without.at(0, 0) ? 0 : 1;
    }
    EXPECT_LT(dark, 8);
}

/// Pixels between the first, blue line at 3 and the second, orange one at 2.
int height_between(bool fitted) {
    Chart two{
        "error", "points", "error", "mm", true, {{"", {10, 30}, {3.0, 3.0}}, {"", {10, 30}, {2.0, 2.0}}}};
    two.shows_values = fitted;
    two.has_key = false;
    const auto picture = chart_picture({two}, {300, 400}, render::Theme::light);
    constexpr int middle = 150;
    int blue = 0;
    int orange = 0;
    for (int y = 0; y < 400; ++y) {
        const render::Pixel& pixel = picture.at(middle, y);
        blue = pixel[2] > pixel[0] + 80 ? y : blue;
        orange = pixel[0] > pixel[2] + 80 ? y : orange;
    }
    return orange - blue;
}

// A decade of an empty plot below values between 2 and 3.
TEST(ChartPicture, FewValuesFillTheirAxis) {
    EXPECT_GT(height_between(true), 200);
    EXPECT_LT(height_between(false), 80);
}

TEST(ChartPicture, NamesStandBelowTheirPlaces) {
    Chart named = chart(1.0);
    named.x_ticks = {{10.0, "MMMM"}, {20.0, ""}, {30.0, ""}};
    Chart unnamed = chart(1.0);
    unnamed.x_ticks = {{10.0, ""}, {20.0, ""}, {30.0, ""}};
    const render::PixelSize size{400, 300};
    EXPECT_GT(different_pixels(chart_picture({named}, size, render::Theme::light),
                               chart_picture({unnamed}, size, render::Theme::light)),
              20U);
}

TEST(ChartPicture, NeedsAChart) {
    EXPECT_THROW((void)chart_picture({}, {100, 100}, render::Theme::light), Defect);
}

} // namespace
} // namespace millwright::viewport
