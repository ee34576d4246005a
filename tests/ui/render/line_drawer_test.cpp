#include "ui/render/line_drawer.h"

#include "core/base/error.h"
#include "tests/ui/render/canvas.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace millwright::render {
namespace {

std::vector<LineVertex> through(const std::vector<glm::vec3>& points) {
    std::vector<LineVertex> vertices;
    for (const glm::vec3& point : points) {
        vertices.push_back({.position = point});
    }
    return vertices;
}

LineStyle red_line(float width_px) {
    LineStyle style;
    style.coloring.color = red;
    style.width_px = width_px;
    return style;
}

Picture drawn_strip(Canvas& canvas, const std::vector<glm::vec3>& points, const LineStyle& style) {
    return canvas.picture([&](const Painter& painter) {
        painter.lines(LineBuffer(through(points), LineTopology::strip), style, canvas.flat());
    });
}

/// How much of a pixel the red line covers, 0 to 1.
double covered(const Pixel& pixel) {
    return (pixel[0] - 51.0) / 204.0;
}

/// Covered pixels down the column x: the line's width if it is level.
double column(const Picture& picture, int x) {
    double sum = 0.0;
    for (int y = 0; y < picture.size.height; ++y) {
        sum += covered(picture.at(x, y));
    }
    return sum;
}

double total(const Picture& picture) {
    double sum = 0.0;
    for (int x = 0; x < picture.size.width; ++x) {
        sum += column(picture, x);
    }
    return sum;
}

TEST(LineDrawer, IsAsWideAsAsked) {
    Canvas canvas({60, 40});
    for (const float width : {0.5F, 1.0F, 2.0F, 3.5F, 9.0F}) {
        const Picture picture =
            drawn_strip(canvas, {{10.0F, 20.3F, 0.0F}, {50.0F, 20.3F, 0.0F}}, red_line(width));
        EXPECT_NEAR(column(picture, 30), static_cast<double>(width), 0.03) << width;
    }
}

TEST(LineDrawer, CoversTheAreaOfACapsuleInAnyDirection) {
    Canvas canvas({80, 80});
    for (const double angle : {0.0, 0.4, 1.1, 2.0}) {
        const auto x = static_cast<float>(25.0 * std::cos(angle));
        const auto y = static_cast<float>(25.0 * std::sin(angle));
        const Picture picture =
            drawn_strip(canvas, {{40.0F - x, 40.0F - y, 0.0F}, {40.0F + x, 40.0F + y, 0.0F}}, red_line(6.0F));
        EXPECT_NEAR(total(picture), 50.0 * 6.0 + std::acos(-1.0) * 9.0, 4.0) << angle;
    }
}

TEST(LineDrawer, HasNoGapAndNoThickeningWhereSegmentsMeet) {
    Canvas canvas({100, 40});
    std::vector<glm::vec3> points;
    for (int i = 0; i <= 40; ++i) {
        points.emplace_back(10.0F + 2.0F * static_cast<float>(i), 20.25F, 0.0F);
    }
    const Picture picture = drawn_strip(canvas, points, red_line(3.0F));
    for (int x = 12; x < 88; ++x) {
        EXPECT_NEAR(column(picture, x), 3.0, 0.05) << x;
    }
}

TEST(LineDrawer, GoesOnBehindTheJointOfALineThatRecedes) {
    Canvas canvas({100, 40});
    std::vector<glm::vec3> points;
    for (int i = 0; i <= 40; ++i) {
        points.emplace_back(
            10.0F + 2.0F * static_cast<float>(i), 20.25F, 40.0F - 2.0F * static_cast<float>(i));
    }
    const Picture picture = drawn_strip(canvas, points, red_line(5.0F));
    for (int x = 14; x < 86; ++x) {
        EXPECT_EQ(picture.at(x, 20), red_pixel) << x;
    }
}

TEST(LineDrawer, DrawsDashesOfTheGivenLengths) {
    Canvas canvas({120, 20});
    LineStyle style = red_line(3.0F);
    style.dash = {.on_px = 6.0F, .off_px = 4.0F};
    const Picture picture = drawn_strip(canvas, {{10.0F, 10.5F, 0.0F}, {110.0F, 10.5F, 0.0F}}, style);
    double along = 0.0;
    for (int x = 20; x < 100; ++x) {
        along += covered(picture.at(x, 10));
    }
    EXPECT_NEAR(along, 80.0 * 0.6, 1.0);
    EXPECT_EQ(picture.at(13, 10), red_pixel);
    EXPECT_EQ(picture.at(18, 10), Canvas::ground_pixel);
}

TEST(LineDrawer, LiesOverASurfaceOfTheSameDepth) {
    Canvas canvas({60, 40});
    const std::array<MeshVertex, 3> corners = {{{.position = {-60.0F, -60.0F, 0.0F}},
                                                {.position = {180.0F, -60.0F, 0.0F}},
                                                {.position = {0.0F, 180.0F, 0.0F}}}};
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(MeshBuffer(corners, std::array<std::uint32_t, 3>{0, 1, 2}), {}, canvas.flat());
        painter.lines(LineBuffer(through({{5.0F, 20.0F, 0.0F}, {55.0F, 20.0F, 0.0F}}), LineTopology::strip),
                      red_line(4.0F),
                      canvas.flat());
    });
    EXPECT_EQ(picture.at(30, 19), red_pixel);
    EXPECT_EQ(picture.at(30, 20), red_pixel);
}

TEST(LineDrawer, IsHiddenByWhatIsInFrontUnlessItIsAnOverlay) {
    Canvas canvas({60, 40});
    const std::array<MeshVertex, 3> corners = {{{.position = {-60.0F, -60.0F, 50.0F}},
                                                {.position = {180.0F, -60.0F, 50.0F}},
                                                {.position = {0.0F, 180.0F, 50.0F}}}};
    for (const Depth depth : {Depth::tested, Depth::ghost, Depth::overlay}) {
        LineStyle style = red_line(4.0F);
        style.depth = depth;
        const Picture picture = canvas.picture([&](const Painter& painter) {
            painter.mesh(MeshBuffer(corners, std::array<std::uint32_t, 3>{0, 1, 2}), {}, canvas.flat());
            painter.lines(
                LineBuffer(through({{5.0F, 20.0F, 0.0F}, {55.0F, 20.0F, 0.0F}}), LineTopology::strip),
                style,
                canvas.flat());
        });
        EXPECT_EQ(picture.at(30, 20) == red_pixel, depth == Depth::overlay);
    }
}

TEST(LineDrawer, DrawsTheAskedSegmentsOnly) {
    Canvas canvas({60, 20});
    const LineBuffer line(
        through({{10.0F, 10.0F, 0.0F}, {20.0F, 10.0F, 0.0F}, {30.0F, 10.0F, 0.0F}, {40.0F, 10.0F, 0.0F}}),
        LineTopology::strip);
    LineStyle style = red_line(2.0F);
    style.first = 1;
    style.count = 1;
    const Picture picture =
        canvas.picture([&](const Painter& painter) { painter.lines(line, style, canvas.flat()); });
    EXPECT_EQ(picture.at(15, 9), Canvas::ground_pixel);
    EXPECT_EQ(picture.at(25, 9), red_pixel);
    EXPECT_EQ(picture.at(35, 9), Canvas::ground_pixel);
    style.first = 99;
    EXPECT_EQ(canvas.picture([&](const Painter& painter) { painter.lines(line, style, canvas.flat()); }),
              filled({60, 20}, Canvas::ground_pixel));
}

TEST(LineDrawer, LeavesTheRoomBetweenSegmentsFree) {
    Canvas canvas({60, 20});
    const LineBuffer segments(
        through({{10.0F, 10.0F, 0.0F}, {20.0F, 10.0F, 0.0F}, {40.0F, 10.0F, 0.0F}, {50.0F, 10.0F, 0.0F}}),
        LineTopology::segments);
    EXPECT_EQ(segments.segment_count(), 2);
    const Picture picture = canvas.picture(
        [&](const Painter& painter) { painter.lines(segments, red_line(2.0F), canvas.flat()); });
    EXPECT_EQ(picture.at(15, 9), red_pixel);
    EXPECT_EQ(picture.at(30, 9), Canvas::ground_pixel);
    EXPECT_EQ(picture.at(45, 9), red_pixel);
}

TEST(LineDrawer, IsWiderOnAMonitorWithSmallerPixels) {
    Canvas canvas({60, 40});
    View view = canvas.flat();
    view.content_scale = 2.0;
    const LineBuffer line(through({{10.0F, 20.0F, 0.0F}, {50.0F, 20.0F, 0.0F}}), LineTopology::strip);
    const Picture picture =
        canvas.picture([&](const Painter& painter) { painter.lines(line, red_line(3.0F), view); });
    EXPECT_NEAR(column(picture, 30), 6.0, 0.03);
}

TEST(LineDrawer, ShowsThePartOfALineThatIsInFrontOfTheEye) {
    Canvas canvas({80, 60});
    const View view = {.view = glm::dmat4(1.0),
                       .projection = glm::perspective(1.2, 4.0 / 3.0, 1.0, 100.0),
                       .size = {80, 60}};
    const LineBuffer line(through({{-2.0F, 0.0F, -10.0F}, {6.0F, 0.0F, 30.0F}}), LineTopology::strip);
    const Picture picture =
        canvas.picture([&](const Painter& painter) { painter.lines(line, red_line(4.0F), view); });
    // It runs from x = -0.2 (at depth 10) to the left out of the picture, as the near plane is reached at x =
    // -0.2.
    EXPECT_GT(total(picture), 10.0);
    EXPECT_NEAR(covered(picture.at(79, 29)), 0.0, 0.01);
}

TEST(LineBuffer, RefusesAnEndWithoutAStart) {
    const OffscreenContext context({4, 4});
    EXPECT_THROW(LineBuffer(std::array<LineVertex, 3>{}, LineTopology::segments), Defect);
}

} // namespace
} // namespace millwright::render
