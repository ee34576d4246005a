// Mouse and keyboard at one frame, for drawing the interface without a window: pictures, tests, recorded
// scripts.
#pragma once

#include "ui/render/gamepad.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace millwright::render {

// Keys by name. The numbers are GLFW's, which are stable; no code outside this folder needs to know that.

enum class Key : int {
    space = 32,
    apostrophe = 39,
    comma = 44,
    minus = 45,
    period = 46,
    slash = 47,
    digit_0 = 48,
    digit_1,
    digit_2,
    digit_3,
    digit_4,
    digit_5,
    digit_6,
    digit_7,
    digit_8,
    digit_9,
    semicolon = 59,
    equal = 61,
    a = 65,
    b,
    c,
    d,
    e,
    f,
    g,
    h,
    i,
    j,
    k,
    l,
    m,
    n,
    o,
    p,
    q,
    r,
    s,
    t,
    u,
    v,
    w,
    x,
    y,
    z,
    left_bracket = 91,
    backslash = 92,
    right_bracket = 93,
    grave = 96,
    escape = 256,
    enter,
    tab,
    backspace,
    insert,
    del,
    right,
    left,
    down,
    up,
    page_up,
    page_down,
    home,
    end,
    f1 = 290,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    keypad_0 = 320,
    keypad_1,
    keypad_2,
    keypad_3,
    keypad_4,
    keypad_5,
    keypad_6,
    keypad_7,
    keypad_8,
    keypad_9,
    keypad_decimal = 330,
    keypad_divide,
    keypad_multiply,
    keypad_subtract,
    keypad_add,
    keypad_enter,
    left_shift = 340,
    left_ctrl,
    left_alt,
    left_super,
    right_shift,
    right_ctrl,
    right_alt,
    right_super,
};

// What was typed, in its order. ImGui takes all characters of a frame before its keys, and a key once:
// of "12 Enter 3" in one slow frame it makes "123 Enter". Here a frame gets no more than it keeps in order.

/// A key that changed, in GLFW's numbers, a character, or a button of the mouse that went down.
struct TypedEvent {
    std::optional<unsigned int> character{}; ///< the rest is of a key
    std::optional<int> button{};             ///< the same
    int key = 0, scancode = 0, action = 0, mods = 0;

    friend bool operator==(const TypedEvent&, const TypedEvent&) = default;
};

class Typing {
public:
    void add(const std::vector<TypedEvent>& events);
    /// For the next frame. Not `into_text`: all of it. Else what comes before the first event that would be
    /// taken out of its order; `was_down` tells of a key whether the last frame saw it down. Keys that are
    /// let go are reported at once, unless they went down among what still waits: nothing is held for longer
    /// than a person holds it.
    [[nodiscard]] std::vector<TypedEvent> next(bool into_text, const std::function<bool(int key)>& was_down);
    /// Something is left for another frame.
    [[nodiscard]] bool waits() const { return !waiting_.empty(); }
    /// That button went down behind something that has to be seen before it.
    [[nodiscard]] bool waits_for_button(int button) const;

private:
    std::vector<TypedEvent> waiting_;
};

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
