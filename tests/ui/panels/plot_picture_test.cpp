// A picture below its path, and as a gray map on which a region is marked.
#include "tests/ui/panels/plot_person.h"
#include "ui/panels/view_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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

} // namespace
} // namespace millwright::panels
