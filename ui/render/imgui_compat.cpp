#include "ui/render/imgui_compat.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace millwright::render {

namespace {

// Before 1.87 ImGui kept keys in an array that the program numbers, and learned only these by name.
constexpr std::array<std::pair<ImGuiKey_, Key>, 22> named_keys = {{{ImGuiKey_Tab, Key::tab},
                                                                   {ImGuiKey_LeftArrow, Key::left},
                                                                   {ImGuiKey_RightArrow, Key::right},
                                                                   {ImGuiKey_UpArrow, Key::up},
                                                                   {ImGuiKey_DownArrow, Key::down},
                                                                   {ImGuiKey_PageUp, Key::page_up},
                                                                   {ImGuiKey_PageDown, Key::page_down},
                                                                   {ImGuiKey_Home, Key::home},
                                                                   {ImGuiKey_End, Key::end},
                                                                   {ImGuiKey_Insert, Key::insert},
                                                                   {ImGuiKey_Delete, Key::del},
                                                                   {ImGuiKey_Backspace, Key::backspace},
                                                                   {ImGuiKey_Space, Key::space},
                                                                   {ImGuiKey_Enter, Key::enter},
                                                                   {ImGuiKey_Escape, Key::escape},
                                                                   {ImGuiKey_KeyPadEnter, Key::keypad_enter},
                                                                   {ImGuiKey_A, Key::a},
                                                                   {ImGuiKey_C, Key::c},
                                                                   {ImGuiKey_V, Key::v},
                                                                   {ImGuiKey_X, Key::x},
                                                                   {ImGuiKey_Y, Key::y},
                                                                   {ImGuiKey_Z, Key::z}}};

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
    return ImGui::IsKeyPressed(static_cast<int>(key), repeat);
}

bool key_down(Key key) {
    return ImGui::IsKeyDown(static_cast<int>(key));
}

void name_keys(ImGuiIO& io) {
    for (const auto& [name, key] : named_keys) {
        io.KeyMap[name] = static_cast<int>(key);
    }
}

void put_input(ImGuiIO& io, const InputState& input) {
    constexpr float elsewhere = -std::numeric_limits<float>::max();
    const bool inside = input.mouse_x >= 0.0F && input.mouse_y >= 0.0F;
    io.MousePos = inside ? ImVec2(input.mouse_x, input.mouse_y) : ImVec2(elsewhere, elsewhere);
    std::ranges::copy(input.buttons, io.MouseDown);
    io.MouseWheel = input.wheel;
    io.KeyCtrl = input.ctrl;
    io.KeyShift = input.shift;
    io.KeyAlt = input.alt;
    std::ranges::fill(io.KeysDown, false);
    for (const Key key : input.keys) {
        io.KeysDown[static_cast<int>(key)] = true;
    }
    io.AddInputCharactersUTF8(input.text.c_str());
    io.DeltaTime = input.seconds;
}

} // namespace millwright::render
