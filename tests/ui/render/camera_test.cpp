#include "ui/render/camera.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::render {
namespace {

constexpr PixelSize picture_size = {800, 500};
constexpr double near_zero = 1e-9;

const Bounds part = {.min = {-50.0, -40.0, -10.0}, .max = {50.0, 60.0, 30.0}};

std::vector<Camera> cameras() {
    std::vector<Camera> all;
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        for (const double pitch : {-1.2, 0.0, 0.6, 0.5 * pi}) {
            for (const double yaw : {-2.0, 0.3, 1.9}) {
                all.emplace_back(CameraPose{.target = {4.0, -3.0, 2.0},
                                            .distance = 250.0,
                                            .yaw = yaw,
                                            .pitch = pitch,
                                            .projection = projection});
            }
        }
    }
    return all;
}

void expect_same(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::length(a - b), near_zero);
}

TEST(Camera, SeesItsTargetInTheMiddle) {
    for (const Camera& camera : cameras()) {
        const auto seen = project(camera.view(picture_size, part), camera.pose().target);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->pixel.x, 400.0, near_zero);
        EXPECT_NEAR(seen->pixel.y, 250.0, near_zero);
    }
}

TEST(Camera, LooksAsGlmsLookAtDoes) {
    for (const Camera& camera : cameras()) {
        const glm::dmat4 ours = camera.view(picture_size, part).view;
        const glm::dmat4 theirs = glm::lookAt(camera.eye(), camera.pose().target, camera.up());
        for (int i = 0; i < 4; ++i) {
            EXPECT_LT(glm::length(ours[i] - theirs[i]), near_zero);
        }
    }
}

TEST(Camera, KeepsZUpAndXLevel) {
    for (const Camera& camera : cameras()) {
        EXPECT_NEAR(camera.right().z, 0.0, near_zero);
        EXPECT_GE(camera.up().z, -near_zero);
        expect_same(glm::cross(camera.right(), camera.up()), camera.backward());
    }
}

TEST(Camera, SeesTheStandardSidesAsDrawingsShowThem) {
    const auto look = [](StandardView side) { return Camera().seen_from(side); };
    expect_same(look(StandardView::top).right(), {1.0, 0.0, 0.0});
    expect_same(look(StandardView::top).up(), {0.0, 1.0, 0.0});
    expect_same(look(StandardView::front).right(), {1.0, 0.0, 0.0});
    expect_same(look(StandardView::front).up(), {0.0, 0.0, 1.0});
    expect_same(look(StandardView::back).right(), {-1.0, 0.0, 0.0});
    expect_same(look(StandardView::right).right(), {0.0, 1.0, 0.0});
    expect_same(look(StandardView::left).right(), {0.0, -1.0, 0.0});
    expect_same(look(StandardView::bottom).backward(), {0.0, 0.0, -1.0});
    expect_same(look(StandardView::iso).backward(), glm::dvec3(1.0, -1.0, 1.0) / std::sqrt(3.0));
}

TEST(Camera, ShowsTheTargetPlaneAtTheSameSizeInBothProjections) {
    const Camera camera({.distance = 120.0, .yaw = 0.2, .pitch = 0.4});
    const glm::dvec3 point = camera.pose().target + 17.0 * camera.right() - 9.0 * camera.up();
    const auto perspective = project(camera.view(picture_size, part), point);
    const auto flat = project(camera.with(Projection::orthographic).view(picture_size, part), point);
    EXPECT_LT(glm::length(perspective->pixel - flat->pixel), near_zero);
}

TEST(Camera, ClipsNoCornerOfTheScene) {
    for (const Camera& camera : cameras()) {
        const View view = camera.view(picture_size, part);
        for (const glm::dvec3& corner : corners(part)) {
            const auto seen = project(view, corner);
            ASSERT_TRUE(seen);
            EXPECT_GT(seen->depth, 0.0);
            EXPECT_LT(seen->depth, 1.0);
        }
    }
}

TEST(Camera, FitsABoxSoThatOneSideJustHasItsMargin) {
    constexpr double aspect = 1.6;
    for (const Camera& camera : cameras()) {
        const View view = camera.fitted(part, aspect).view(picture_size, part);
        double reach = 0.0; // 1 is the border of the picture
        for (const glm::dvec3& corner : corners(part)) {
            const glm::dvec2 pixel = project(view, corner)->pixel;
            reach = std::max({reach, std::abs(pixel.x - 400.0) / 400.0, std::abs(pixel.y - 250.0) / 250.0});
        }
        EXPECT_LT(reach, 1.0);
        EXPECT_NEAR(reach, 1.0 / 1.08, 1e-6);
    }
}

TEST(Camera, CentresWhatItFits) {
    for (const Camera& camera : cameras()) {
        const View view = camera.fitted(part, 1.6).view(picture_size, part);
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const glm::dvec3& corner : corners(part)) {
            low = glm::min(low, project(view, corner)->pixel);
            high = glm::max(high, project(view, corner)->pixel);
        }
        const bool fills_width = (high.x - low.x) / 800.0 > (high.y - low.y) / 500.0;
        EXPECT_NEAR(fills_width ? 0.5 * (low.x + high.x) - 400.0 : 0.5 * (low.y + high.y) - 250.0, 0.0, 1e-6);
    }
}

TEST(Camera, IsNotMovedByAnEmptyBoxOrNoPoints) {
    const Camera camera;
    EXPECT_EQ(camera.fitted(Bounds{}, 1.5).pose(), camera.pose());
    EXPECT_EQ(camera.fitted(std::span<const glm::dvec3>(), 1.5).pose(), camera.pose());
}

TEST(Camera, KeepsItsDistanceWhenItFitsASinglePoint) {
    const glm::dvec3 point(1.0, 2.0, 3.0);
    const Camera fitted = Camera().fitted(Bounds{.min = point, .max = point}, 1.5);
    expect_same(fitted.pose().target, point);
    EXPECT_GT(fitted.pose().distance, 0.0);
}

TEST(Camera, LetsThePointUnderTheHandFollowAPan) {
    for (const Camera& camera : cameras()) {
        const glm::dvec3 held = camera.pose().target + 20.0 * camera.right() + 5.0 * camera.up();
        const glm::dvec2 before = project(camera.view(picture_size, part), held)->pixel;
        const glm::dvec2 drag(37.0, -12.0);
        const glm::dvec2 after =
            project(camera.panned(drag, picture_size).view(picture_size, part), held)->pixel;
        EXPECT_LT(glm::length(after - before - drag), 1e-6);
    }
}

TEST(Camera, KeepsThePointUnderTheCursorWhenItZooms) {
    for (const Camera& camera : cameras()) {
        const glm::dvec3 held = camera.pose().target - 30.0 * camera.right() + 12.0 * camera.up();
        const glm::dvec2 cursor = project(camera.view(picture_size, part), held)->pixel;
        for (const double factor : {0.5, 1.7}) {
            const Camera zoomed = camera.zoomed(factor, cursor, picture_size);
            EXPECT_LT(glm::length(project(zoomed.view(picture_size, part), held)->pixel - cursor), 1e-6);
            EXPECT_NEAR(zoomed.pose().distance, 250.0 * factor, near_zero);
        }
    }
}

TEST(Camera, TurnsHalfAroundForADragOfThePicturesHeight) {
    const Camera camera({.yaw = 0.3, .pitch = 0.2});
    const Camera turned = camera.orbited(glm::dvec2(500.0, 0.0), picture_size);
    EXPECT_NEAR(std::cos(turned.pose().yaw - 0.3), -1.0, near_zero);
    EXPECT_NEAR(camera.orbited(glm::dvec2(0.0, 50.0), picture_size).pose().pitch, 0.2 + 0.1 * pi, near_zero);
}

TEST(Camera, MovesTheNearSideWithTheHandWhenItTurns) {
    const Camera camera;
    const glm::dvec3 near_side = camera.pose().target + 20.0 * camera.backward();
    const View turned = camera.orbited(glm::dvec2(10.0, 10.0), picture_size).view(picture_size, part);
    const glm::dvec2 seen = project(turned, near_side)->pixel;
    EXPECT_GT(seen.x, 400.0);
    EXPECT_GT(seen.y, 250.0);
}

TEST(Camera, StopsTurningStraightAboveAndBelow) {
    EXPECT_NEAR(Camera().orbited(0.0, 10.0).pose().pitch, 0.5 * pi, near_zero);
    EXPECT_NEAR(Camera().orbited(0.0, -10.0).pose().pitch, -0.5 * pi, near_zero);
}

TEST(Camera, NeverReachesDistanceZeroHoweverOftenItZooms) {
    Camera camera;
    for (int i = 0; i < 500; ++i) {
        camera = camera.zoomed(0.5, {10.0, 10.0}, picture_size);
    }
    EXPECT_GT(camera.pose().distance, 0.0);
    for (int i = 0; i < 500; ++i) {
        camera = camera.zoomed(2.0, {10.0, 10.0}, picture_size);
    }
    EXPECT_LT(camera.pose().distance, 1e9);
}

TEST(Camera, CannotBeMadeOfNumbersThatAreNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Camera(CameraPose{.yaw = nan}), Defect);
    EXPECT_THROW(Camera(CameraPose{.target = {0.0, nan, 0.0}}), Defect);
    EXPECT_THROW(Camera(CameraPose{.distance = 0.0}), Defect);
    EXPECT_THROW(static_cast<void>(Camera().zoomed(0.0, {0.0, 0.0}, picture_size)), Defect);
}

// T4: x_s = X + Y cos 30, y_s = Z + Y sin 30 of the thesis's listing, in one scale.
TEST(Camera, SeesObliquelyAsTheThesisDoes) {
    const Camera camera =
        Camera(CameraPose{.target = {4.0, -3.0, 2.0}, .distance = 250.0}).seen_from(StandardView::oblique);
    EXPECT_EQ(camera.pose().projection, Projection::oblique);
    const View view = camera.view(picture_size, part);
    const auto origin = project(view, {0.0, 0.0, 0.0});
    ASSERT_TRUE(origin);
    const double scale = 0.5 * picture_size.height / half_height(camera);
    for (const glm::dvec3& point : corners(part)) {
        const auto seen = project(view, point);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->pixel.x - origin->pixel.x, scale * (point.x + point.y * std::cos(pi / 6.0)), 1e-6);
        EXPECT_NEAR(origin->pixel.y - seen->pixel.y, scale * (point.z + point.y * std::sin(pi / 6.0)), 1e-6);
        EXPECT_GT(seen->depth, 0.0);
        EXPECT_LT(seen->depth, 1.0);
        // The line of sight through the pixel goes through the point, along the view.
        const Ray sight = ray(view, seen->pixel);
        const glm::dvec3 off = glm::cross(point - sight.origin, sight.direction);
        EXPECT_LT(glm::length(off), 1e-6);
        expect_same(sight.direction, looking_along(view));
    }
    const auto target = project(view, camera.pose().target);
    EXPECT_NEAR(target->pixel.x, 400.0, near_zero);
    EXPECT_NEAR(target->pixel.y, 250.0, near_zero);
}

TEST(Camera, FitsAnObliqueViewIntoThePicture) {
    const Camera camera = Camera().seen_from(StandardView::oblique).fitted(part, aspect(picture_size));
    double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
    for (const glm::dvec3& point : corners(part)) {
        const auto seen = project(camera.view(picture_size, part), point);
        ASSERT_TRUE(seen);
        low_x = std::min(low_x, seen->pixel.x);
        high_x = std::max(high_x, seen->pixel.x);
        low_y = std::min(low_y, seen->pixel.y);
        high_y = std::max(high_y, seen->pixel.y);
    }
    EXPECT_NEAR(low_x + high_x, picture_size.width, 1e-6);
    EXPECT_NEAR(low_y + high_y, picture_size.height, 1e-6);
    EXPECT_GT(low_x, 0.0);
    EXPECT_GT(low_y, 0.0);
    EXPECT_LT(std::min(low_x, low_y), 60.0);
}

TEST(Camera, LeavesAnObliqueViewForAPlane) {
    const Camera oblique = Camera().seen_from(StandardView::oblique);
    EXPECT_EQ(oblique.seen_from(StandardView::front).pose().projection, Projection::orthographic);
    // Light falls as from the front.
    const glm::dmat4 plain = unsheared(oblique.view(picture_size, part));
    const glm::dmat4 front = oblique.with(Projection::orthographic).view(picture_size, part).view;
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(plain[i] - front[i]), near_zero);
    }
}

} // namespace
} // namespace millwright::render
