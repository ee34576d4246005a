#include "ui/render/internal/gamepad_state.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <limits>

namespace millwright::render {
namespace {

TEST(GamepadState, PointsAwayFromThePersonForPositiveValues) {
    GLFWgamepadstate state{};
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.5F;
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -1.0F; // pushed away, as GLFW says it
    state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = 0.25F;
    state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = GLFW_PRESS;
    state.buttons[GLFW_GAMEPAD_BUTTON_DPAD_DOWN] = GLFW_PRESS;
    Gamepad expected;
    expected.left_x = 0.5F;
    expected.left_y = 1.0F;
    expected.right_y = -0.25F;
    expected.left_bumper = true;
    expected.cross_y = -1;
    EXPECT_EQ(gamepad_of(state), expected);
}

TEST(GamepadState, TakesWhatIsNoPositionForAStickAtRest) {
    GLFWgamepadstate state{};
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = std::numeric_limits<float>::quiet_NaN();
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -7.0F;
    EXPECT_EQ(gamepad_of(state).left_x, 0.0F);
    EXPECT_EQ(gamepad_of(state).left_y, 1.0F);
}

} // namespace
} // namespace millwright::render
