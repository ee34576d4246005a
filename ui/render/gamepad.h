// A gamepad at one frame, laid out as an Xbox controller (GLFW's gamepad mapping).
#pragma once

namespace millwright::render {

/// Sticks from -1 to 1: to the right, and up, away from the person, are positive.
struct Gamepad {
    float left_x = 0.0F, left_y = 0.0F;
    float right_x = 0.0F, right_y = 0.0F;
    bool left_bumper = false, right_bumper = false;
    int cross_x = 0, cross_y = 0; ///< -1, 0 or 1: to the right, and up, are positive

    friend bool operator==(const Gamepad& a, const Gamepad& b) = default;
};

} // namespace millwright::render
