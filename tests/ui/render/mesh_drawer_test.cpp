#include "ui/render/mesh_drawer.h"

#include "core/base/error.h"
#include "tests/ui/render/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Square = std::array<std::uint32_t, 6>;

constexpr Square square_indices = {0, 2, 1, 0, 3, 2}; // counterclockwise seen from +z, with y downwards

/// Covers x and y from `low` to `high` at height z.
MeshBuffer square(float low, float high, float z, const glm::vec3& normal = {0.0F, 0.0F, 1.0F}) {
    std::array<MeshVertex, 4> corners;
    corners.fill({.normal = normal});
    corners[0].position = {low, low, z};
    corners[1].position = {high, low, z};
    corners[2].position = {high, high, z};
    corners[3].position = {low, high, z};
    for (MeshVertex& corner : corners) {
        corner.value = corner.position.x;
    }
    return MeshBuffer(corners, square_indices);
}

MeshStyle plain(const glm::vec4& color) {
    MeshStyle style;
    style.coloring.color = color;
    style.lit = false;
    return style;
}

const glm::vec4 blue{0.0F, 0.0F, 1.0F, 1.0F};

TEST(MeshDrawer, CoversThePixelsWhoseCentresAreInside) {
    Canvas canvas({40, 40});
    const std::array<MeshVertex, 3> corners = {{{.position = {5.0F, 5.0F, 0.0F}},
                                                {.position = {35.0F, 5.0F, 0.0F}},
                                                {.position = {5.0F, 35.0F, 0.0F}}}};
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(MeshBuffer(corners, Triangle{0, 1, 2}), plain(red), canvas.flat());
    });
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            const double cx = x + 0.5;
            const double cy = y + 0.5;
            if (std::abs(cx + cy - 40.0) > 0.01) { // on the long side itself either is right
                const bool inside = cx > 5.0 && cy > 5.0 && cx + cy < 40.0;
                EXPECT_EQ(picture.at(x, y), inside ? red_pixel : Canvas::ground_pixel) << x << ", " << y;
            }
        }
    }
}

TEST(MeshDrawer, HidesWhatIsBehindInAnyOrder) {
    Canvas canvas({20, 20});
    for (const bool near_first : {true, false}) {
        const Picture picture = canvas.picture([&](const Painter& painter) {
            painter.mesh(
                square(0, 20, near_first ? 5.0F : -5.0F), plain(near_first ? red : blue), canvas.flat());
            painter.mesh(
                square(0, 20, near_first ? -5.0F : 5.0F), plain(near_first ? blue : red), canvas.flat());
        });
        EXPECT_EQ(picture.at(10, 10), red_pixel);
    }
}

TEST(MeshDrawer, LetsASeeThroughSurfaceShowWhatIsBehind) {
    Canvas canvas({20, 20});
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(square(0, 20, -5.0F), plain(blue), canvas.flat());
        MeshStyle glass = plain(red);
        glass.coloring.opacity = 0.5F;
        glass.depth = Depth::ghost;
        painter.mesh(square(0, 20, 5.0F), glass, canvas.flat());
    });
    EXPECT_NEAR(picture.at(10, 10)[0], 128, 1);
    EXPECT_NEAR(picture.at(10, 10)[2], 127, 1);
    EXPECT_EQ(picture.at(10, 10)[3], 255);
}

TEST(MeshDrawer, ShowsValuesThroughTheColourMapAsTheLegendDoes) {
    Canvas canvas({100, 8});
    MeshStyle style = plain(red);
    style.coloring.from = ColorFrom::value;
    style.coloring.scale = {.map = ColorMap::cividis, .low = 10.0, .high = 90.0, .limit = 80.0};
    const Picture picture = canvas.picture(
        [&](const Painter& painter) { painter.mesh(square(0, 100, 0.0F), style, canvas.flat()); });
    for (const int x : {2, 20, 47, 70, 79, 80, 95}) {
        const glm::vec3 expected = color_of(style.coloring.scale, x + 0.5);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(picture.at(x, 4)[static_cast<std::size_t>(i)], 255.0F * expected[i], 1.5F) << x;
        }
    }
}

TEST(MeshDrawer, BlendsTheVerticesOwnColours) {
    Canvas canvas({20, 20});
    std::array<MeshVertex, 3> corners = {{{.position = {0.0F, 0.0F, 0.0F}},
                                          {.position = {40.0F, 0.0F, 0.0F}},
                                          {.position = {0.0F, 40.0F, 0.0F}}}};
    corners[0].color = {1.0F, 0.0F, 0.0F, 1.0F};
    corners[1].color = corners[2].color = {0.0F, 1.0F, 0.0F, 1.0F};
    MeshStyle style = plain(red);
    style.coloring.from = ColorFrom::vertex;
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(MeshBuffer(corners, Triangle{0, 1, 2}), style, canvas.flat());
    });
    EXPECT_NEAR(picture.at(9, 9)[0], 255.0 * (1.0 - 19.0 / 40.0), 1.0);
    EXPECT_NEAR(picture.at(9, 9)[1], 255.0 * 19.0 / 40.0, 1.0);
}

TEST(MeshDrawer, IsBrighterTowardsTheLightThanAwayFromIt) {
    Canvas canvas({20, 20});
    const auto brightness = [&canvas](const glm::vec3& normal) {
        MeshStyle style;
        style.coloring.color = {0.5F, 0.5F, 0.5F, 1.0F};
        const Picture picture = canvas.picture(
            [&](const Painter& painter) { painter.mesh(square(0, 20, 0.0F, normal), style, canvas.flat()); });
        return picture.at(10, 10)[0];
    };
    const int left_above = brightness({-0.5F, -0.5F, 1.0F}); // y is downwards here
    const int right_below = brightness({0.5F, 0.5F, 1.0F});
    EXPECT_GT(left_above, right_below + 20);
    EXPECT_GT(right_below, 40) << "what is turned away from the light still has a shape";
}

TEST(MeshDrawer, ShowsTheOtherSideInItsOwnColour) {
    Canvas canvas({20, 20});
    MeshStyle style = plain(red);
    style.back_color = glm::vec3(0.0F, 0.0F, 1.0F);
    const Picture front = canvas.picture(
        [&](const Painter& painter) { painter.mesh(square(0, 20, 0.0F), style, canvas.flat()); });
    style.model[2][2] = -1.0F; // seen from below: half a turn about the x axis through the middle
    style.model[1][1] = -1.0F;
    style.model[3][1] = 20.0F;
    const Picture back = canvas.picture(
        [&](const Painter& painter) { painter.mesh(square(0, 20, 0.0F), style, canvas.flat()); });
    EXPECT_EQ(front.at(10, 10), red_pixel);
    EXPECT_EQ(back.at(10, 10), (Pixel{0, 0, 255, 255}));
}

TEST(MeshDrawer, LeavesOutTheInsideOfAClosedBodyUnlessItIsSeenThrough) {
    Canvas canvas({20, 20});
    const auto middle = [&](const glm::vec4& color, bool turned) {
        MeshStyle style = plain(color);
        style.closed = true;
        if (turned) {
            style.model[2][2] = style.model[1][1] = -1.0F;
            style.model[3][1] = 20.0F;
        }
        return canvas
            .picture([&](const Painter& painter) { painter.mesh(square(0, 20, 0.0F), style, canvas.flat()); })
            .at(10, 10);
    };
    EXPECT_EQ(middle(red, false), red_pixel);
    EXPECT_EQ(middle(red, true), Canvas::ground_pixel);
    EXPECT_NE(middle(glm::vec4(1.0F, 0.0F, 0.0F, 0.5F), true), Canvas::ground_pixel);
}

TEST(MeshDrawer, IsPlacedByItsModelMatrix) {
    Canvas canvas({40, 40});
    MeshStyle style = plain(red);
    style.model[3] = {20.0F, 10.0F, 0.0F, 1.0F};
    const Picture picture = canvas.picture(
        [&](const Painter& painter) { painter.mesh(square(0, 10, 0.0F), style, canvas.flat()); });
    EXPECT_EQ(picture.at(25, 15), red_pixel);
    EXPECT_EQ(picture.at(19, 15), Canvas::ground_pixel);
    EXPECT_EQ(picture.at(25, 9), Canvas::ground_pixel);
}

TEST(MeshDrawer, HasSmoothOutlinesWithSeveralSamples) {
    Canvas canvas({40, 40}, 4);
    const std::array<MeshVertex, 3> corners = {{{.position = {3.0F, 2.0F, 0.0F}},
                                                {.position = {37.0F, 9.0F, 0.0F}},
                                                {.position = {8.0F, 38.0F, 0.0F}}}};
    const Picture picture = canvas.picture([&](const Painter& painter) {
        painter.mesh(MeshBuffer(corners, Triangle{0, 1, 2}), plain(red), canvas.flat());
    });
    const auto between = [](const Pixel& p) { return p[0] > 60 && p[0] < 250; };
    EXPECT_GT(std::ranges::count_if(picture.pixels, between), 30);
}

TEST(MeshBuffer, RefusesTrianglesThatAreNone) {
    const OffscreenContext context({4, 4});
    const std::array<MeshVertex, 3> corners;
    EXPECT_THROW(MeshBuffer(corners, Triangle{0, 1, 3}), Defect);
    EXPECT_THROW(MeshBuffer(corners, std::array<std::uint32_t, 2>{0, 1}), Defect);
}

} // namespace
} // namespace millwright::render
