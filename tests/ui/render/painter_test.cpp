#include "ui/render/painter.h"

#include "tests/ui/render/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::render {
namespace {

TEST(Painter, FillsTheBackgroundWithExactlyItsColour) {
    Canvas canvas({40, 30});
    const Picture picture = canvas.picture([](const Painter&) {});
    EXPECT_TRUE(
        std::ranges::all_of(picture.pixels, [](const Pixel& p) { return p == Canvas::ground_pixel; }));
}

TEST(Painter, FadesTheBackgroundFromTopToBottomWithoutBands) {
    Canvas canvas({64, 400});
    ViewColors colors = Canvas::ground();
    colors.background_top = glm::vec3(0.3F);
    colors.background_bottom = glm::vec3(0.2F);
    const Picture picture = canvas.picture([&](const Painter& painter) { painter.background(colors); });
    EXPECT_NEAR(picture.at(5, 0)[0], 0.3 * 255.0, 1.0);
    EXPECT_NEAR(picture.at(5, 399)[0], 0.2 * 255.0, 1.0);
    int plain_rows = 0; // a row of one colour is a band's inside
    for (int y = 0; y < 400; ++y) {
        bool plain = true;
        for (int x = 1; x < 64; ++x) {
            plain = plain && picture.at(x, y) == picture.at(0, y);
        }
        plain_rows += plain ? 1 : 0;
    }
    EXPECT_LT(plain_rows, 80);
}

TEST(Painter, DrawsTheSamePictureTwice) {
    Canvas canvas({80, 60}, 4);
    const auto draw = [&canvas](const Painter& painter) {
        const std::array<LineVertex, 2> line = {
            {{.position = {3.0F, 4.0F, 0.0F}}, {.position = {70.0F, 50.0F, 0.0F}}}};
        painter.lines(LineBuffer(line, LineTopology::strip), {.width_px = 3.3F}, canvas.flat());
    };
    EXPECT_EQ(canvas.picture(draw), canvas.picture(draw));
}

TEST(Painter, DrawsNothingForEmptyBuffers) {
    Canvas canvas({16, 16});
    const Picture picture = canvas.picture([&canvas](const Painter& painter) {
        painter.mesh(MeshBuffer(), {}, canvas.flat());
        painter.mesh(MeshBuffer({}, {}), {}, canvas.flat());
        painter.lines(LineBuffer(), {}, canvas.flat());
        painter.lines(LineBuffer(std::array<LineVertex, 1>{}, LineTopology::strip), {}, canvas.flat());
        painter.points(PointBuffer(), {}, canvas.flat());
    });
    EXPECT_EQ(picture, filled({16, 16}, Canvas::ground_pixel));
}

} // namespace
} // namespace millwright::render
