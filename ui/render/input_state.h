// Mouse and keyboard at one frame, for drawing the interface without a window: pictures, tests, recorded
// scripts.
#pragma once

#include "ui/render/gamepad.h"
#include "ui/render/keys.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace millwright::render {

struct InputState {
    float mouse_x = -1.0F;         ///< pixels from the left; both negative: the mouse is elsewhere
    float mouse_y = -1.0F;         ///< pixels from the top
    std::array<bool, 3> buttons{}; ///< left, right, middle
    float wheel = 0.0F;            ///< notches in this frame, up is positive
    bool ctrl = false, shift = false, alt = false;
    std::vector<Key> keys = {};          ///< held down
    std::string text = {};               ///< typed in this frame, UTF-8
    bool focused = true;                 ///< the window has the keyboard
    std::optional<Gamepad> gamepad = {}; ///< nothing where none is connected
    float seconds = 1.0F / 60.0F;        ///< since the frame before; must be positive
};

} // namespace millwright::render
