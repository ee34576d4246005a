#include "core/plot/stroke_svg.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::plot {
namespace {

using testing::HasSubstr;
using testing::Not;

const Strokes two_pens = {{.pen = 1, .points = {{10.0, 20.0}, {40.0, 20.0}, {40.0, 50.0}}},
                          {.pen = 1, .points = {{0.0, 0.0}}},
                          {.pen = 5, .points = {{5.0, 5.0}, {5.0, 6.0}}}};

TEST(StrokeSvg, HasEachStrokeInMillimetresWithYUp) {
    const std::string text = svg_text(two_pens, AirInSvg::left_out);
    // 40 x 50 mm and a margin of 2 mm around.
    EXPECT_THAT(text, HasSubstr("width=\"44.0000mm\" height=\"54.0000mm\""));
    EXPECT_THAT(text, HasSubstr("M12.0000 32.0000L12.0000 32.0000L42.0000 32.0000L42.0000 2.0000\n"));
    EXPECT_THAT(text, HasSubstr("M2.0000 52.0000L2.0000 52.0000\n")); // a dot
    EXPECT_EQ(std::ranges::count(text, 'M'), 3);
    EXPECT_THAT(text, Not(HasSubstr("dasharray")));
}

TEST(StrokeSvg, HasAColourForEachPenAndDashesForTravel) {
    const std::string text = svg_text(two_pens, AirInSvg::shown);
    EXPECT_THAT(text, HasSubstr("#c71f1f")); // red
    EXPECT_THAT(text, HasSubstr("#2647d1")); // blue
    EXPECT_THAT(text, HasSubstr("dasharray"));
    EXPECT_THAT(text, HasSubstr("M2.0000 52.0000L12.0000 32.0000\n")); // from the origin
    EXPECT_EQ(std::ranges::count(text, 'M'), 6);
}

TEST(StrokeSvg, OfNothingIsRefused) {
    EXPECT_THROW(static_cast<void>(svg_text({}, AirInSvg::shown)), Error);
}

TEST(PenGroup, IsThatOfTheThesisForAnyNumber) {
    EXPECT_EQ(pen_group(1), 0);
    EXPECT_EQ(pen_group(6), 5);
    EXPECT_EQ(pen_group(7), 0);
    EXPECT_EQ(pen_group(0), 5);
    EXPECT_EQ(pen_group(-2147483647 - 1), pen_group(4));
}

} // namespace
} // namespace millwright::plot
