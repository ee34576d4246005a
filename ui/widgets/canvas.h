// A picture one works in with the mouse, such as the 3D view: shows a texture and tells what the mouse does.
#pragma once

#include "ui/widgets/ui.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace millwright::widgets {

enum class MouseButton { left = 0, right = 1, middle = 2 };

/// What the mouse does over a canvas in this frame. A button pressed on it stays the canvas's until let go.
struct Pointer {
    Point at;    ///< from the canvas's upper left corner
    Point moved; ///< since the last frame
    bool hovered = false;
    std::optional<MouseButton> pressed = {};  ///< went down in this frame
    std::optional<MouseButton> held = {};     ///< is down since it was pressed here
    std::optional<MouseButton> released = {}; ///< was held and went up in this frame
    bool double_clicked = false;
    float wheel = 0.0F; ///< notches, away from the user is positive
    bool shift = false;
    bool ctrl = false;
    bool alt = false;
};

struct Canvas {
    Rect rect;
    Pointer pointer;
};

/// `texture`: an OpenGL name with its first row at the bottom, as a framebuffer has it; 0 shows the ground
/// only.
Canvas canvas(Ui& ui, std::string_view id, const Rect& place, std::uintptr_t texture);

/// A picture that is only looked at, such as a preview; first row on top.
void picture(Ui& ui, std::string_view id, Point size, std::uintptr_t texture);

/// The ground of words whose middle is `at`, in the window.
[[nodiscard]] Rect label_box(const Ui& ui, Point at, std::string_view text);

/// Words over a canvas, on a ground that keeps them readable; `at` is their middle, in the window.
void label_at(Ui& ui, Point at, std::string_view text, Colour colour);

} // namespace millwright::widgets
