#include "ui/widgets/canvas.h"

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/imgui_inside.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::widgets {

namespace {

constexpr std::array buttons{MouseButton::left, MouseButton::right, MouseButton::middle};

int index_of(MouseButton button) {
    return static_cast<int>(button);
}

ImTextureID texture_id(std::uintptr_t texture) {
    return reinterpret_cast<ImTextureID>(texture); // as ImGui's OpenGL back end wants it
}

/// The button that the canvas holds is kept by path: -1 none.
void follow_buttons(double& kept, bool hovered, Pointer& pointer) {
    for (const MouseButton button : buttons) {
        if (kept < 0.0 && hovered && ImGui::IsMouseClicked(index_of(button))) {
            kept = index_of(button);
            pointer.pressed = button;
        }
    }
    if (kept < 0.0) {
        return;
    }
    const MouseButton button = buttons[static_cast<std::size_t>(kept)];
    if (ImGui::IsMouseDown(index_of(button))) {
        pointer.held = button;
    } else {
        pointer.released = button;
        kept = -1.0;
    }
}

} // namespace

Canvas canvas(Ui& ui, std::string_view id, const Rect& place, std::uintptr_t texture) {
    const std::string own = ui.path(id);
    constexpr ImGuiButtonFlags any_button = ImGuiButtonFlags_MouseButtonLeft |
                                            ImGuiButtonFlags_MouseButtonRight |
                                            ImGuiButtonFlags_MouseButtonMiddle;
    overlaid_button(own, place, any_button); // legends and buttons on the picture come later and win
    keep_wheel();
    const std::string& on_top = ui.state().under_mouse_before;
    const bool hovered = ImGui::IsItemHovered() && (on_top.empty() || on_top == own);
    if (ImGui::IsItemHovered()) {
        ui.state().under_mouse = own;
    }
    if (texture != 0) {
        ImGui::GetWindowDrawList()->AddImage(
            texture_id(texture), upper_left(place), lower_right(place), {0.0F, 1.0F}, {1.0F, 0.0F});
    } else {
        fill(place, ui.colours().field);
    }
    record_at(ui, own, place);
    const ImGuiIO& io = ImGui::GetIO();
    Canvas now{place, {}};
    now.pointer.at = {io.MousePos.x - place.x, io.MousePos.y - place.y};
    now.pointer.moved = {io.MouseDelta.x, io.MouseDelta.y};
    now.pointer.hovered = hovered;
    now.pointer.wheel = hovered ? io.MouseWheel : 0.0F;
    now.pointer.double_clicked = hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    now.pointer.shift = io.KeyShift;
    now.pointer.ctrl = io.KeyCtrl;
    now.pointer.alt = io.KeyAlt;
    double& kept = ui.state().memory.try_emplace(own + "@button", -1.0).first->second;
    follow_buttons(kept, hovered, now.pointer);
    return now;
}

void picture(Ui& ui, std::string_view id, Point size, std::uintptr_t texture) {
    const Slot slot(ui, size.x, size.y);
    record_at(ui, ui.path(id), slot.rect());
    fill(slot.rect(), ui.colours().field, ui.px(gaps::rounding));
    if (texture != 0) {
        ImGui::GetWindowDrawList()->AddImageRounded(texture_id(texture),
                                                    upper_left(slot.rect()),
                                                    lower_right(slot.rect()),
                                                    {0.0F, 0.0F},
                                                    {1.0F, 1.0F},
                                                    IM_COL32_WHITE,
                                                    ui.px(gaps::rounding));
    }
}

Rect label_box(const Ui& ui, Point at, std::string_view text) {
    const ImFont* font = ui.look().fonts.small;
    const float width = text_width(font, text) + ui.px(10.0F);
    const float height = font->FontSize + ui.px(4.0F);
    return {std::round(at.x - 0.5F * width), std::round(at.y - 0.5F * height), width, height};
}

void label_at(Ui& ui, Point at, std::string_view text, Colour colour) {
    const Rect box = label_box(ui, at, text);
    fill(box, faded(ui.colours().pane, 0.8), ui.px(3.0F));
    draw_text(ui, ui.look().fonts.small, box, colour, text, Align::centre);
}

} // namespace millwright::widgets
