// The oracle of projection is a pinhole written down by hand: eye on the z axis, looking down.
#include "ui/render/view.h"

#include "ui/render/camera.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::render {
namespace {

constexpr double pixel_tolerance = 1e-9;

/// Eye at (0, 0, 10), x to the right, y up; 90 degrees from top to bottom, so that at depth d one sees d up
/// and down.
View pinhole() {
    return {.view = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -10.0)),
            .projection = glm::perspective(std::acos(0.0), 2.0, 1.0, 100.0),
            .size = {400, 200}};
}

TEST(View, ProjectsLikeAPinhole) {
    const auto seen = project(pinhole(), {3.0, 2.0, 6.0}); // depth 4: x 3/8 of the half width, y 1/2
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->pixel.x, 200.0 + 200.0 * 3.0 / 8.0, pixel_tolerance);
    EXPECT_NEAR(seen->pixel.y, 100.0 - 100.0 * 0.5, pixel_tolerance);
}

TEST(View, HasDepthZeroAtTheNearPlaneAndOneAtTheFarPlane) {
    EXPECT_NEAR(project(pinhole(), {0.0, 0.0, 9.0})->depth, 0.0, 1e-12);
    EXPECT_NEAR(project(pinhole(), {0.0, 0.0, -90.0})->depth, 1.0, 1e-12);
}

TEST(View, ShowsNothingAtOrBehindTheEye) {
    EXPECT_FALSE(project(pinhole(), {1.0, 1.0, 10.0}));
    EXPECT_FALSE(project(pinhole(), {1.0, 1.0, 11.0}));
}

TEST(View, SendsTheRayOfAPixelThroughEverythingThatAppearsThere) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        const Camera camera({.target = {5.0, -7.0, 3.0}, .distance = 80.0, .yaw = 0.4, .pitch = 0.9});
        const Bounds scene = {.min = glm::dvec3(-30.0), .max = glm::dvec3(30.0)};
        const View view = camera.with(projection).view({640, 480}, scene);
        for (const glm::dvec3 point : {glm::dvec3(10.0, 2.0, -4.0), glm::dvec3(-20.0, -9.0, 25.0)}) {
            const Ray line = ray(view, project(view, point)->pixel);
            const glm::dvec3 arm = point - line.origin;
            EXPECT_LT(glm::length(glm::cross(arm, line.direction)), 1e-9);
            EXPECT_GT(glm::dot(arm, line.direction), 0.0);
            EXPECT_NEAR(glm::length(line.direction), 1.0, 1e-12);
        }
    }
}

TEST(View, LooksDownInThePinhole) {
    EXPECT_EQ(looking_along(pinhole()), glm::dvec3(0.0, 0.0, -1.0));
}

TEST(View, SaysHowLongAPixelIsAtADepth) {
    EXPECT_NEAR(
        pixel_length(pinhole(), {0.0, 0.0, 0.0}), 20.0 / 200.0, 1e-12); // depth 10 shows 20 on 200 pixels
    EXPECT_NEAR(pixel_length(pinhole(), {3.0, 1.0, 6.0}), 8.0 / 200.0, 1e-12);
}

TEST(Ray, MeetsAPlaneWhereTheEquationSays) {
    const Ray line = {.origin = {0.0, 0.0, 5.0}, .direction = glm::normalize(glm::dvec3(1.0, 0.0, -1.0))};
    const auto met = meet_plane(line, {9.0, 9.0, 1.0}, {0.0, 0.0, 2.0});
    ASSERT_TRUE(met);
    EXPECT_LT(glm::length(*met - glm::dvec3(4.0, 0.0, 1.0)), 1e-12);
}

TEST(Ray, MeetsNoPlaneThatIsParallelOrBehind) {
    const Ray down = {.origin = {0.0, 0.0, 5.0}, .direction = {0.0, 0.0, -1.0}};
    EXPECT_FALSE(meet_plane(down, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
    EXPECT_FALSE(meet_plane(down, {0.0, 0.0, 6.0}, {0.0, 0.0, 1.0}));
}

} // namespace
} // namespace millwright::render
