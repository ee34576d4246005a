#include "ui/render/imgui_compat.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace millwright::render {

namespace {

/// The keys from `first` to `last`; ImGui names them in the same order, beginning with `name`.
struct NamedKeys {
    ImGuiKey name;
    Key first, last;
};

constexpr NamedKeys named(ImGuiKey name, Key key) {
    return {name, key, key};
}

// Before 1.87 ImGui knew only these keys by name, and others by the program's own numbers.
constexpr std::array named_keys = {
    named(ImGuiKey_Tab, Key::tab),
    named(ImGuiKey_LeftArrow, Key::left),
    named(ImGuiKey_RightArrow, Key::right),
    named(ImGuiKey_UpArrow, Key::up),
    named(ImGuiKey_DownArrow, Key::down),
    named(ImGuiKey_PageUp, Key::page_up),
    named(ImGuiKey_PageDown, Key::page_down),
    named(ImGuiKey_Home, Key::home),
    named(ImGuiKey_End, Key::end),
    named(ImGuiKey_Insert, Key::insert),
    named(ImGuiKey_Delete, Key::del),
    named(ImGuiKey_Backspace, Key::backspace),
    named(ImGuiKey_Space, Key::space),
    named(ImGuiKey_Enter, Key::enter),
    named(ImGuiKey_Escape, Key::escape),
#if IMGUI_VERSION_NUM >= 18700
    named(ImGuiKey_KeypadEnter, Key::keypad_enter),
    NamedKeys{ImGuiKey_A, Key::a, Key::z},
    NamedKeys{ImGuiKey_0, Key::digit_0, Key::digit_9},
    NamedKeys{ImGuiKey_F1, Key::f1, Key::f12},
    NamedKeys{ImGuiKey_Keypad0, Key::keypad_0, Key::keypad_9},
    named(ImGuiKey_Apostrophe, Key::apostrophe),
    named(ImGuiKey_Comma, Key::comma),
    named(ImGuiKey_Minus, Key::minus),
    named(ImGuiKey_Period, Key::period),
    named(ImGuiKey_Slash, Key::slash),
    named(ImGuiKey_Semicolon, Key::semicolon),
    named(ImGuiKey_Equal, Key::equal),
    named(ImGuiKey_LeftBracket, Key::left_bracket),
    named(ImGuiKey_Backslash, Key::backslash),
    named(ImGuiKey_RightBracket, Key::right_bracket),
    named(ImGuiKey_GraveAccent, Key::grave),
    named(ImGuiKey_KeypadDecimal, Key::keypad_decimal),
    named(ImGuiKey_KeypadDivide, Key::keypad_divide),
    named(ImGuiKey_KeypadMultiply, Key::keypad_multiply),
    named(ImGuiKey_KeypadSubtract, Key::keypad_subtract),
    named(ImGuiKey_KeypadAdd, Key::keypad_add),
    named(ImGuiKey_LeftShift, Key::left_shift),
    named(ImGuiKey_LeftCtrl, Key::left_ctrl),
    named(ImGuiKey_LeftAlt, Key::left_alt),
    named(ImGuiKey_LeftSuper, Key::left_super),
    named(ImGuiKey_RightShift, Key::right_shift),
    named(ImGuiKey_RightCtrl, Key::right_ctrl),
    named(ImGuiKey_RightAlt, Key::right_alt),
    named(ImGuiKey_RightSuper, Key::right_super),
#else
    named(ImGuiKey_KeyPadEnter, Key::keypad_enter),
    named(ImGuiKey_A, Key::a),
    named(ImGuiKey_C, Key::c),
    named(ImGuiKey_V, Key::v),
    named(ImGuiKey_X, Key::x),
    named(ImGuiKey_Y, Key::y),
    named(ImGuiKey_Z, Key::z),
#endif
};

#if IMGUI_VERSION_NUM >= 18700
ImGuiKey imgui_key(Key key) {
    const auto* const range = std::ranges::find_if(
        named_keys, [key](const NamedKeys& keys) { return keys.first <= key && key <= keys.last; });
    if (range == named_keys.end()) {
        return ImGuiKey_None;
    }
    return static_cast<ImGuiKey>(range->name + static_cast<int>(key) - static_cast<int>(range->first));
}
#else
int imgui_key(Key key) {
    return static_cast<int>(key);
}
#endif

/// ImGui's mouse: far away when it is not over the window.
ImVec2 mouse_place(const InputState& input) {
    constexpr float elsewhere = -std::numeric_limits<float>::max();
    const bool known = input.mouse_x >= 0.0F || input.mouse_y >= 0.0F; // a drag goes on beyond the window
    return known ? ImVec2(input.mouse_x, input.mouse_y) : ImVec2(elsewhere, elsewhere);
}

} // namespace

ImTextureID texture_id(GlId texture) {
    const std::uintptr_t id = texture;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the interface of ImGui
    return reinterpret_cast<ImTextureID>(id);
}

void show(const ViewTarget& target, const ImVec2& size) {
    if (target.texture() == 0U) {
        ImGui::Dummy(size);
        return;
    }
    ImGui::Image(texture_id(target.texture()), size, ImVec2(0.0F, 1.0F), ImVec2(1.0F, 0.0F));
}

bool key_pressed(Key key, bool repeat) {
    return ImGui::IsKeyPressed(imgui_key(key), repeat);
}

bool key_down(Key key) {
    return ImGui::IsKeyDown(imgui_key(key));
}

#if IMGUI_VERSION_NUM >= 18700

void prepare_input(ImGuiIO& io) {
    io.ConfigInputTrickleEventQueue = false;
}

void put_keys(ImGuiIO& io, const std::vector<Key>& down, const Modifiers& modifiers) {
    io.AddKeyEvent(ImGuiMod_Ctrl, modifiers.ctrl);
    io.AddKeyEvent(ImGuiMod_Shift, modifiers.shift);
    io.AddKeyEvent(ImGuiMod_Alt, modifiers.alt);
    for (const NamedKeys& keys : named_keys) {
        for (int number = static_cast<int>(keys.first); number <= static_cast<int>(keys.last); ++number) {
            const Key key = static_cast<Key>(number);
            io.AddKeyEvent(imgui_key(key), std::ranges::find(down, key) != down.end());
        }
    }
}

void put_button(ImGuiIO& io, int button, bool down) {
    io.AddMouseButtonEvent(button, down);
}

void put_input(ImGuiIO& io, const InputState& input) {
    io.ClearEventsQueue();
    const ImVec2 mouse = mouse_place(input);
    io.AddMousePosEvent(mouse.x, mouse.y);
    for (std::size_t button = 0; button < input.buttons.size(); ++button) {
        put_button(io, static_cast<int>(button), input.buttons[button]);
    }
    io.AddMouseWheelEvent(0.0F, input.wheel);
    put_keys(io, input.keys, {.ctrl = input.ctrl, .shift = input.shift, .alt = input.alt});
    io.AddInputCharactersUTF8(input.text.c_str());
    io.DeltaTime = input.seconds;
}

#else

void prepare_input(ImGuiIO& io) {
    for (const NamedKeys& keys : named_keys) {
        io.KeyMap[keys.name] = static_cast<int>(keys.first);
    }
}

void put_keys(ImGuiIO& io, const std::vector<Key>& down, const Modifiers& modifiers) {
    io.KeyCtrl = modifiers.ctrl;
    io.KeyShift = modifiers.shift;
    io.KeyAlt = modifiers.alt;
    std::ranges::fill(io.KeysDown, false);
    for (const Key key : down) {
        io.KeysDown[static_cast<int>(key)] = true;
    }
}

void put_button(ImGuiIO& io, int button, bool down) {
    io.MouseDown[button] = down;
}

void put_input(ImGuiIO& io, const InputState& input) {
    io.MousePos = mouse_place(input);
    std::ranges::copy(input.buttons, io.MouseDown);
    io.MouseWheel = input.wheel;
    put_keys(io, input.keys, {.ctrl = input.ctrl, .shift = input.shift, .alt = input.alt});
    io.AddInputCharactersUTF8(input.text.c_str());
    io.DeltaTime = input.seconds;
}

#endif

} // namespace millwright::render
