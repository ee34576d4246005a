// A picture below its path, and as a gray map on which a region is marked.
#include "tests/support/bmp_shape.h"
#include "tests/ui/person/plot_person.h"
#include "ui/window/view_panel.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::panels {
namespace {

using test::PlotPerson;

TEST(PlotPicture, LiesBelowItsPathWhereAPersonWantsToSeeIt) {
    PlotPerson bench("assets/samples/pictures/boat.png");
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    ASSERT_TRUE(bench.made().shown_picture);
    const render::Picture before = bench.person.picture_of("view/iso");
    bench.person.click("inspector/picture");
    bench.settle();
    EXPECT_GT(render::difference(before, bench.person.picture_of("view/iso"), 16).fraction, 0.05);
    bench.person.keep("plot-picture-below");
}

TEST(PlotPicture, ARegionIsMarkedOnTheGrayMapByTwoClicks) {
    PlotPerson bench("assets/samples/pictures/boat.png", {1280, 1400});
    bench.person.click("lower/tabs/picture");
    bench.person.frames(3);
    const widgets::Rect map = bench.person.place("lower/gray_map");
    const auto at = [&](float x, float y) { return widgets::Point{map.x + x * map.w, map.y + y * map.h}; };
    bench.person.hover(at(0.5F, 0.4F));
    bench.person.frames(3);
    bench.person.keep("plot-gray-map");
    bench.person.click_at(at(0.3F, 0.1F)); // the rest of the map may be scrolled out of sight
    bench.person.frames(2);
    EXPECT_FALSE(bench.plot().settings().picture.region);
    bench.person.click_at(at(0.7F, 0.4F));
    bench.settle();
    const auto region = bench.plot().settings().picture.region;
    ASSERT_TRUE(region);
    const auto shown = bench.made().shown_picture;
    ASSERT_TRUE(shown);
    const double width = shown->picture.width * shown->picture.file_pixels;
    const double height = shown->picture.height * shown->picture.file_pixels;
    EXPECT_NEAR(region->left / width, 0.3, 0.1);
    EXPECT_NEAR(region->width / width, 0.4, 0.1);
    EXPECT_NEAR(region->top / height, 0.1, 0.1);
    EXPECT_NEAR(region->height / height, 0.3, 0.1);
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    bench.person.frames(3);
    bench.person.keep("plot-gray-map-region");
    const widgets::Rect framed = bench.person.place("lower/gray_map/frame");
    EXPECT_NEAR((framed.x - map.x) / map.w, region->left / width, 0.01);
    EXPECT_NEAR(framed.w / map.w, region->width / width, 0.01);
    EXPECT_NEAR((framed.y - map.y) / map.h, region->top / height, 0.01);
    EXPECT_NEAR(framed.h / map.h, region->height / height, 0.01);
    // The region is cut at the origin, and the whole picture lies around it.
    EXPECT_NEAR(bench.made().picture_size.x() / (shown->cell.x() * shown->picture.width),
                region->width / width,
                0.01);
    EXPECT_LT(shown->corner.x(), 0.0);
    EXPECT_LT(shown->corner.y(), 0.0);
    bench.person.click("lower/whole");
    bench.settle();
    EXPECT_FALSE(bench.plot().settings().picture.region);
}

// i counts rows from the top, j columns from the left, as the thesis's matrix; rows and columns exchanged, or
// counted from below, would read other numbers.
TEST(PlotPicture, TheReadoutNamesTheCellUnderTheMouseWithItsGrayAndPlace) {
    const test::ScratchFolder scratch;
    constexpr int width = 24, height = 16;
    test::write_bmp(scratch / "slope.bmp", width, height, 10'000, 10'000); // square pixels
    PlotPerson bench(scratch / "slope.bmp", {1280, 1400});
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    bench.person.click("lower/tabs/picture");
    bench.person.frames(3);
    const widgets::Rect map = bench.person.place("lower/gray_map");
    const auto shown = bench.made().shown_picture;
    ASSERT_TRUE(shown);
    ASSERT_EQ(shown->picture.width, width);
    ASSERT_EQ(shown->picture.height, height);
    EXPECT_FALSE(bench.person.sees("tip"));
    // The rest of the map may be scrolled out of sight.
    for (const auto& [i, j] : {std::pair(0, 0), std::pair(2, 21), std::pair(6, 3), std::pair(5, 5)}) {
        const auto share = [](int n, int count) {
            return static_cast<float>(n) / static_cast<float>(count - 1);
        };
        const float x = std::clamp(share(j, width), 0.005F, 0.995F),
                    y = std::clamp(share(i, height), 0.005F, 0.995F);
        bench.person.hover({map.x + x * map.w, map.y + y * map.h});
        bench.person.frames(2);
        ASSERT_TRUE(bench.person.sees("tip")) << i << ' ' << j;
        // As written to the file, where rows count from below.
        const int gray = 255 * (j + height - 1 - i) / (width + height);
        const std::string tip = bench.person.refusal("tip");
        EXPECT_THAT(tip, testing::StartsWith(fmt::format("G({}, {}) = {}\n", i, j, gray)));
        EXPECT_THAT(tip,
                    testing::HasSubstr(fmt::format("x {:.2f} mm, y {:.2f} mm",
                                                   shown->corner.x() + j * shown->cell.x(),
                                                   shown->corner.y() + (height - 1 - i) * shown->cell.y())));
    }
    bench.person.hover({map.x + 0.5F * map.w, map.y - 30.0F});
    bench.person.frames(2);
    EXPECT_FALSE(bench.person.sees("tip") && bench.person.refusal("tip").starts_with("G("));
}

// A region counts the file's pixels, not the square ones that are cut; cells at the edge have fewer of them.
TEST(PlotPicture, ARegionOfPixelsThatAreNotSquareIsMarked) {
    const test::ScratchFolder scratch;
    test::write_bmp(scratch / "high.bmp", 301, 401, 10'000, 5'000);
    PlotPerson bench(scratch / "high.bmp", {1280, 1400});
    bench.person.app().view_state().panes.plot_lower = 150.0F; // as if dragged: low enough to scroll
    bench.person.frames(3);
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    bench.person.click("lower/tabs/picture");
    bench.person.frames(3);
    const widgets::Rect map = bench.person.place("lower/gray_map");
    EXPECT_NEAR(map.h / map.w, 2.0 * 401.0 / 301.0, 0.1);
    const auto at = [&](float x, float y) { return widgets::Point{map.x + x * map.w, map.y + y * map.h}; };
    bench.person.click_at(at(0.5F, 0.3F));
    bench.person.frames(2);
    bench.person.click_at(at(0.999F, 0.1F));
    bench.settle();
    const auto region = bench.plot().settings().picture.region;
    ASSERT_TRUE(region);
    const int right = region->width == 0 ? 301 : region->left + region->width;
    EXPECT_NEAR(right, 301, 2) << "a pixel of the screen is more than a cell here";
    EXPECT_NEAR(region->left, 150, 10);
    EXPECT_NEAR(region->top, 40, 10);
    EXPECT_NEAR(region->height, 80, 10);
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    EXPECT_NEAR(bench.made().picture_size.y() / bench.made().picture_size.x(),
                2.0 * region->height / (right - region->left),
                0.02);
    const float before = map.w;
    bench.person.click("lower/fill");
    bench.person.frames(3);
    EXPECT_GT(bench.person.place("lower/gray_map").w, 1.5F * before);
    bench.person.keep("plot-gray-map-wide");
    bench.person.click("lower/fill");
    bench.person.frames(3);
    EXPECT_NEAR(bench.person.place("lower/gray_map").w, before, 1.0F);
    constexpr float end_of_pane = 1400.0F - 38.0F; // the status bar
    EXPECT_GT(bench.person.place("lower/gray_map").bottom(), end_of_pane - 20.0F) << "it scrolls";
    bench.person.click("lower/fit");
    bench.person.frames(3);
    EXPECT_LT(bench.person.place("lower/gray_map").bottom(), end_of_pane - 20.0F) << "with its numbers";
    bench.person.keep("plot-gray-map-fit");
}

} // namespace
} // namespace millwright::panels
