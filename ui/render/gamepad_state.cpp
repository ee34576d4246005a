#include "ui/render/internal/gamepad_state.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace millwright::render {

namespace {

float stick(float value) {
    return std::isfinite(value) ? std::clamp(value, -1.0F, 1.0F) : 0.0F;
}

} // namespace

Gamepad gamepad_of(const GLFWgamepadstate& state) {
    const auto down = [&](int button) { return state.buttons[button] == GLFW_PRESS; };
    Gamepad pad;
    pad.left_x = stick(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X]);
    pad.left_y = -stick(state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]); // GLFW's are positive towards the person
    pad.right_x = stick(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X]);
    pad.right_y = -stick(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]);
    pad.left_bumper = down(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER);
    pad.right_bumper = down(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER);
    const auto between = [&](int plus, int minus) { return (down(plus) ? 1 : 0) - (down(minus) ? 1 : 0); };
    pad.cross_x = between(GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, GLFW_GAMEPAD_BUTTON_DPAD_LEFT);
    pad.cross_y = between(GLFW_GAMEPAD_BUTTON_DPAD_UP, GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
    return pad;
}

} // namespace millwright::render
