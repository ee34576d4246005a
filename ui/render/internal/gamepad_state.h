// GLFW's gamepad in our words.
#pragma once

#include "ui/render/gamepad.h"

struct GLFWgamepadstate;

namespace millwright::render {

/// What is no number counts as a stick at rest.
[[nodiscard]] Gamepad gamepad_of(const GLFWgamepadstate& state);

} // namespace millwright::render
