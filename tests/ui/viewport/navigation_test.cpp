#include "ui/viewport/navigation.h"

#include "tests/ui/viewport/views.h"
#include "ui/render/convert.h"

#include <gtest/gtest.h>

namespace millwright::viewport {
namespace {

using test::view_size;
using widgets::MouseButton;
using widgets::Pointer;

Pointer dragging(MouseButton button) {
    Pointer pointer;
    pointer.hovered = true;
    pointer.held = button;
    pointer.moved = {30.0F, -20.0F};
    return pointer;
}

bool same(const render::Camera& a, const render::Camera& b) {
    return a.pose() == b.pose();
}

TEST(Navigation, OrbitsWithTheMiddleAndTheRightButton) {
    const render::Camera camera;
    const render::Camera expected = camera.orbited(glm::dvec2(30.0, -20.0), view_size);
    EXPECT_TRUE(same(navigated(camera, dragging(MouseButton::middle), view_size), expected));
    EXPECT_TRUE(same(navigated(camera, dragging(MouseButton::right), view_size), expected));
}

TEST(Navigation, LeavesTheLeftButtonToTheSceneUnlessAltIsHeld) {
    const render::Camera camera;
    Pointer left = dragging(MouseButton::left);
    EXPECT_TRUE(same(navigated(camera, left, view_size), camera));
    left.alt = true;
    EXPECT_TRUE(same(navigated(camera, left, view_size), camera.orbited(glm::dvec2(30.0, -20.0), view_size)));
}

TEST(Navigation, PansWithShift) {
    const render::Camera camera;
    Pointer pointer = dragging(MouseButton::middle);
    pointer.shift = true;
    EXPECT_TRUE(
        same(navigated(camera, pointer, view_size), camera.panned(glm::dvec2(30.0, -20.0), view_size)));
}

// T4.
TEST(Navigation, ZoomsToTheMouse) {
    const render::Camera camera;
    Pointer pointer;
    pointer.hovered = true;
    pointer.at = {500.0F, 100.0F};
    pointer.wheel = 2.0F;
    const render::Camera closer = navigated(camera, pointer, view_size);
    EXPECT_LT(closer.pose().distance, camera.pose().distance);
    const render::Bounds scene = {.min = glm::dvec3(-50.0), .max = glm::dvec3(50.0)};
    const glm::dvec2 pixel = {500.0, 100.0};
    const auto before = meet_plane(ray(camera.view(view_size, scene), pixel), {}, camera.backward());
    const auto after = meet_plane(ray(closer.view(view_size, scene), pixel), {}, camera.backward());
    ASSERT_TRUE(before && after);
    EXPECT_LT((render::to_core(*before) - render::to_core(*after)).norm(), 1e-6);
    pointer.wheel = -2.0F;
    EXPECT_GT(navigated(camera, pointer, view_size).pose().distance, camera.pose().distance);
}

} // namespace
} // namespace millwright::viewport
