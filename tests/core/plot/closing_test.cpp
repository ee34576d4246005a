#include "core/base/error.h"
#include "core/plot/linking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::plot {
namespace {

Stroke line(const Vec2& a, const Vec2& b, int pen = 1) {
    return {.pen = pen, .points = {a, b}};
}

/// A square of 100 mm as LINE entities draw it: in any order and direction.
Strokes four_lines() {
    return {line({0, 0}, {100, 0}),
            line({0, 100}, {0, 0}),
            line({100, 0}, {100, 100}),
            line({0, 100}, {100, 100})};
}

TEST(Closing, LinesThatGoAroundBecomeAnOutline) {
    Strokes drawn = four_lines();
    drawn.insert(drawn.begin() + 1, line({200, 0}, {300, 50}));
    const Strokes joined = rings_joined(drawn);
    ASSERT_EQ(joined.size(), 2U);
    EXPECT_EQ(joined[0].points, (std::vector<Vec2>{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}}));
    EXPECT_EQ(joined[1], drawn[1]);
    EXPECT_EQ(closed_outlines(joined).size(), 1U);
}

TEST(Closing, EndsMayBeAsFarApartAsPlottersRound) {
    Strokes drawn = four_lines();
    drawn[2].points[1] = {100.02, 100.02};
    const Strokes joined = rings_joined(drawn);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined[0].points.front(), joined[0].points.back());
    drawn[2].points[1] = {100.2, 100.2};
    EXPECT_EQ(rings_joined(drawn), drawn);
}

// What could be joined in two ways is left as it is drawn, and so is what does not go around.
TEST(Closing, NothingIsGuessed) {
    Strokes tee = four_lines();
    tee.push_back(line({100, 100}, {150, 150}));
    EXPECT_EQ(rings_joined(tee), tee);
    Strokes colours = four_lines();
    colours[1].pen = 2;
    EXPECT_EQ(rings_joined(colours), colours);
    Strokes open = four_lines();
    open.pop_back();
    EXPECT_EQ(rings_joined(open), open);
    const Strokes there_and_back{line({0, 0}, {100, 0}), line({100, 0}, {0, 0})};
    EXPECT_EQ(rings_joined(there_and_back), there_and_back);
    const Strokes dots{{.pen = 1, .points = {{0, 0}}}, {.pen = 1, .points = {{0, 0}}}};
    EXPECT_EQ(rings_joined(dots), dots);
}

// It was cut on the line, 3 mm too small, with a notice.
TEST(Closing, APartThatIsCutOutsideIsLargerByTheToolHoweverItWasDrawn) {
    StrokePlan plan;
    plan.side = CutterSide::outside;
    EXPECT_NEAR(draw_length(planned(four_lines(), plan).strokes), 412.0, 1e-6);
    Strokes open = four_lines();
    open.pop_back();
    EXPECT_THROW((void)outlines_for(open, plan), Error);
    plan.side = CutterSide::on_line;
    EXPECT_EQ(outlines_for(four_lines(), plan), four_lines());
}

} // namespace
} // namespace millwright::plot
