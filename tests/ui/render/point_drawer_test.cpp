#include "ui/render/point_drawer.h"

#include "tests/ui/render/canvas.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace millwright::render {
namespace {

Picture drawn_point(Canvas& canvas, const PointVertex& point, const PointStyle& style) {
    return canvas.picture([&](const Painter& painter) {
        painter.points(PointBuffer(std::array<PointVertex, 1>{point}), style, canvas.flat());
    });
}

PointStyle red_point(float size_px) {
    PointStyle style;
    style.coloring.color = red;
    style.size_px = size_px;
    return style;
}

/// The red area in pixels.
double area(const Picture& picture) {
    double sum = 0.0;
    for (const Pixel& pixel : picture.pixels) {
        sum += (pixel[0] - 51.0) / 204.0;
    }
    return sum;
}

const PointVertex middle = {.position = {20.2F, 19.7F, 0.0F}};

TEST(PointDrawer, CoversTheAreaOfADisc) {
    Canvas canvas({40, 40});
    for (const float size : {4.0F, 9.0F, 20.0F}) {
        const double expected = std::acos(-1.0) * static_cast<double>(size * size) / 4.0;
        EXPECT_NEAR(area(drawn_point(canvas, middle, red_point(size))), expected, 0.03 * expected + 0.5);
    }
}

TEST(PointDrawer, PutsTheRingInsideItsSize) {
    Canvas canvas({40, 40});
    PointStyle style = red_point(20.0F);
    style.ring_px = 4.0F;
    style.ring_color = {0.0F, 0.0F, 1.0F, 1.0F};
    const Picture picture = drawn_point(canvas, middle, style);
    EXPECT_EQ(picture.at(20, 20), red_pixel);
    EXPECT_EQ(picture.at(28, 20), (Pixel{0, 0, 255, 255}));
    EXPECT_EQ(picture.at(32, 20), Canvas::ground_pixel);
}

TEST(PointDrawer, MarksSelectedPointsBySizeAndColour) {
    Canvas canvas({40, 40});
    PointStyle style = red_point(6.0F);
    style.selected_color = {0.0F, 1.0F, 0.0F, 1.0F};
    style.selected_size_px = 16.0F;
    PointVertex selected = middle;
    selected.selected = 1.0F;
    const Picture picture = drawn_point(canvas, selected, style);
    EXPECT_EQ(picture.at(20, 20), (Pixel{0, 255, 0, 255}));
    EXPECT_EQ(picture.at(26, 20), (Pixel{0, 255, 0, 255}));
}

TEST(PointDrawer, ShowsAValueThroughTheColourMap) {
    Canvas canvas({40, 40});
    PointStyle style = red_point(20.0F);
    style.coloring.from = ColorFrom::value;
    style.coloring.scale = {.low = 0.0, .high = 10.0};
    PointVertex point = middle;
    point.value = 3.0F;
    const glm::vec3 expected = color_of(style.coloring.scale, 3.0);
    EXPECT_NEAR(drawn_point(canvas, point, style).at(20, 20)[1], 255.0F * expected.g, 1.5F);
}

TEST(PointDrawer, IsNotCutByTheSurfaceItLiesOn) {
    Canvas canvas({40, 40});
    const std::array<MeshVertex, 3> corners = {{{.position = {-60.0F, -60.0F, 0.0F}},
                                                {.position = {180.0F, -60.0F, 0.0F}},
                                                {.position = {0.0F, 180.0F, 0.0F}}}};
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(MeshBuffer(corners, std::array<std::uint32_t, 3>{0, 1, 2}), {}, canvas.flat());
        painter.points(PointBuffer(std::array<PointVertex, 1>{middle}), red_point(12.0F), canvas.flat());
    });
    EXPECT_EQ(picture.at(20, 20), red_pixel);
    EXPECT_EQ(picture.at(24, 20), red_pixel);
}

} // namespace
} // namespace millwright::render
