#include "ui/render/path_drawer.h"

#include "tests/ui/render/canvas.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace millwright::render {
namespace {

constexpr std::uint16_t rapid = 1, feed = 2;
const glm::vec4 green{0.0F, 1.0F, 0.0F, 1.0F};
constexpr Pixel green_pixel = {0, 255, 0, 255};

/// Level, 40 pixels long: a rapid to x = 20, a feed to x = 40, a feed to x = 60.
PathBuffer level_path() {
    const glm::vec3 min(0.0F, 20.5F, 0.0F), max(60.0F, 20.5F, 0.0F);
    std::vector<PathVertex> vertices;
    const std::array<std::uint16_t, 4> kinds{0, rapid, feed, feed};
    for (int n = 0; n < 4; ++n) {
        const std::array<float, 3> point{20.0F * static_cast<float>(n), 20.5F, 0.0F};
        vertices.push_back(path_vertex(point.data(), kinds[static_cast<std::size_t>(n)], min, max));
    }
    return {vertices, min, max};
}

Picture drawn_path(const std::vector<std::uint16_t>& indices, int done = -1) {
    Canvas canvas({60, 40});
    PathStyle style;
    style.color[rapid] = glm::vec4(0.0F); // not drawn
    style.color[feed] = red;
    style.done_color = {glm::vec4(0.0F), green, green, green};
    style.done = done;
    return canvas.picture(
        [&](const Painter& painter) { painter.path(level_path(), indices, style, canvas.flat()); });
}

TEST(PathDrawer, DrawsEachPieceInTheColourOfItsKind) {
    const Picture picture = drawn_path({0, 1, 2, 3});
    EXPECT_EQ(picture.at(10, 20), Canvas::ground_pixel);
    EXPECT_EQ(picture.at(30, 20), red_pixel);
    EXPECT_EQ(picture.at(50, 20), red_pixel);
    EXPECT_EQ(picture.at(30, 10), Canvas::ground_pixel);
}

TEST(PathDrawer, LeavesOutWhatIsNotAmongTheIndices) {
    EXPECT_EQ(drawn_path({2, 3}).at(30, 20), Canvas::ground_pixel);
    EXPECT_EQ(drawn_path({1, 3}).at(30, 20), red_pixel); // straight on
    const Picture picture = drawn_path({1, 2, path_restart, 3});
    EXPECT_EQ(picture.at(30, 20), red_pixel);
    EXPECT_EQ(picture.at(50, 20), Canvas::ground_pixel);
}

TEST(PathDrawer, ShowsWhatIsDone) {
    const Picture picture = drawn_path({0, 1, 2, 3}, 2);
    EXPECT_EQ(picture.at(10, 20), green_pixel);
    EXPECT_EQ(picture.at(30, 20), green_pixel);
    EXPECT_EQ(picture.at(50, 20), red_pixel);
}

TEST(PathDrawer, DrawsNothingOfNothing) {
    Canvas canvas({8, 8});
    const Picture picture = canvas.picture(
        [&](const Painter& painter) { painter.path(PathBuffer(), {}, PathStyle{}, canvas.flat()); });
    EXPECT_EQ(picture.at(4, 4), Canvas::ground_pixel);
}

} // namespace
} // namespace millwright::render
