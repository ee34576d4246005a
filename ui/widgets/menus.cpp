#include "ui/widgets/menus.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/imgui_inside.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::widgets {

namespace {

constexpr float list_width = 360.0F;
constexpr float switches_width = 220.0F;
constexpr float mark_width = 30.0F; // left of the words: a tick or an eye

/// `corner`, moved up as far as the last rows of a list of this height need.
ImVec2 on_screen(const Ui& ui, const ImVec2& corner, float height) {
    const float lowest = ImGui::GetIO().DisplaySize.y - ui.px(gaps::tiny) - height;
    return {corner.x, std::min(corner.y, std::max(lowest, 0.0F))};
}

enum class Stay { open, close };

/// At `corner`, else where the mouse was. A list is not seen in its first frame, in which ImGui measures it.
/// One that is higher than the window scrolls.
Guard begin_list(Ui& ui,
                 std::string_view id,
                 const std::string& popup,
                 const std::optional<ImVec2>& corner,
                 float width = list_width,
                 Stay stay = Stay::open) {
    const float pad = ui.px(gaps::tiny);
    ImGuiStorage& heights = *ImGui::GetStateStorage();
    const ImGuiID height = ImGui::GetID((popup + "@height").c_str());
    if (corner && ImGui::IsPopupOpen(popup.c_str())) {
        ImGui::SetNextWindowPos(on_screen(ui, *corner, heights.GetFloat(height)));
    }
    ImGui::SetNextWindowSize({ui.px(width), 0.0F});
    ImGui::SetNextWindowSizeConstraints({ui.px(width), 0.0F},
                                        {ui.px(width), ImGui::GetIO().DisplaySize.y - 2.0F * pad});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
    const bool open = ImGui::BeginPopup(popup.c_str());
    ui.state().places.enter(id);
    if (!open) {
        ImGui::PopStyleVar(2);
        return {ui, [](Ui& with) { with.state().places.leave(); }, false};
    }
    if (stay == Stay::close || ui.escape_pressed()) {
        ImGui::CloseCurrentPopup();
    }
    // Seen for the first time it stands where a list without rows would.
    ImGui::SetWindowPos(on_screen(ui, ImGui::GetWindowPos(), ImGui::GetWindowSize().y));
    heights.SetFloat(height, ImGui::GetWindowSize().y);
    return {ui, [](Ui& with) {
                ImGui::EndPopup();
                ImGui::PopStyleVar(2);
                with.state().places.leave();
            }};
}

} // namespace

float menu_width(const Ui& ui, std::string_view label) {
    return std::ceil(text_width(ui.look().fonts.text, label) + ui.px(20.0F));
}

Guard menu(Ui& ui, std::string_view id, std::string_view label) {
    const std::string own = ui.path(id);
    const std::string popup = own + "@menu";
    Rect place;
    {
        const Slot slot(ui, menu_width(ui, label), ui.px(gaps::row));
        place = slot.rect();
        const Press now = press(ui, own, place);
        const bool open = ImGui::IsPopupOpen(popup.c_str());
        fill(place, open || now.hovered ? ui.colours().hover : Colour{0}, ui.px(gaps::rounding));
        draw_text(ui, ui.look().fonts.text, place, ui.colours().text, label, Align::centre);
        const bool mouse_here = ImGui::IsMouseHoveringRect(upper_left(place), lower_right(place));
        const bool neighbour_open = !open && ui.state().open_menu_frame >= ImGui::GetFrameCount() - 1;
        if (now.clicked || (neighbour_open && mouse_here)) {
            ImGui::OpenPopup(popup.c_str());
        }
        if (open) {
            ui.state().open_menu_frame = ImGui::GetFrameCount();
        }
    }
    return begin_list(ui, id, popup, ImVec2(place.x, place.bottom() + ui.px(2.0F)));
}

Guard submenu(Ui& ui, std::string_view id, std::string_view label) {
    const std::string own = ui.path(id);
    const std::string popup = own + "@menu";
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    Rect row;
    {
        const Slot slot(ui, 0.0F, ui.px(gaps::row));
        row = slot.rect();
        const Press now = press(ui, own, row);
        const Palette& colours = ui.colours();
        const bool open = ImGui::IsPopupOpen(popup.c_str());
        fill(row, now.hovered || now.focused || open ? colours.hover : Colour{0}, ui.px(gaps::rounding));
        const float tick = ui.px(mark_width);
        const Rect words{row.x + tick, row.y, row.w - 2.0F * tick, row.h};
        draw_text(ui, ui.look().fonts.text, words, colours.text, label);
        const Rect arrow{row.right() - tick, row.y, tick, row.h};
        draw_text(ui, ui.look().fonts.small, arrow, colours.muted, icons::chevron_right, Align::centre);
        if (now.clicked || (now.hovered && !open)) {
            ImGui::OpenPopup(popup.c_str());
        }
    }
    const bool in_menu = ImGui::IsMouseHoveringRect(corner, {corner.x + size.x, corner.y + size.y}, false);
    const bool on_row = ImGui::IsMouseHoveringRect(upper_left(row), lower_right(row), false);
    return begin_list(ui,
                      id,
                      popup,
                      ImVec2(corner.x + size.x, row.y - ui.px(gaps::tiny)),
                      list_width,
                      in_menu && !on_row ? Stay::close : Stay::open);
}

Guard menu_button(Ui& ui, std::string_view id, std::string_view icon, std::string_view tip) {
    const std::string popup = ui.path(id) + "@menu";
    const bool open = ImGui::IsPopupOpen(popup.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ui.icon_button(id, icon, tip, {}, open)) {
        ImGui::OpenPopup(popup.c_str());
    }
    return begin_list(
        ui, id, popup, ImVec2(corner.x - ui.px(switches_width + gaps::tiny), corner.y), switches_width);
}

Guard context_menu(Ui& ui, std::string_view id, const Rect& place) {
    const std::string popup = ui.path(id) + "@menu";
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) && ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect(upper_left(place), lower_right(place))) {
        ImGui::OpenPopup(popup.c_str());
    }
    return begin_list(ui, id, popup, std::nullopt);
}

bool menu_item(Ui& ui,
               std::string_view id,
               std::string_view label,
               std::string_view shortcut,
               const Permission& permission,
               bool is_on) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const Rect& row = slot.rect();
    const Press now = press(ui, ui.path(id), row, permission);
    const Palette& colours = ui.colours();
    const double opacity = now.enabled ? 1.0 : 0.45;
    fill(row, now.hovered || now.focused ? colours.hover : Colour{0}, ui.px(gaps::rounding));
    const float tick = ui.px(mark_width);
    if (is_on) {
        draw_text(ui,
                  ui.look().fonts.small,
                  {row.x, row.y, tick, row.h},
                  colours.accent,
                  icons::check,
                  Align::centre);
    }
    const float keys = text_width(ui.look().fonts.small, shortcut);
    const Rect right{row.right() - keys - ui.px(10.0F), row.y, keys, row.h};
    draw_text(ui, ui.look().fonts.small, right, faded(colours.muted, opacity), shortcut);
    const Rect words{row.x + tick, row.y, right.x - row.x - tick - ui.px(8.0F), row.h};
    draw_text(ui, ui.look().fonts.text, words, faded(colours.text, opacity), label);
    const bool entered = now.focused && now.enabled && ui.enter_pressed();
    if (now.clicked || entered) {
        close_lists();
        ui.state().open_menu_frame = 0; // the mouse may rest on the menu's name, which would open it again
    }
    return now.clicked || entered;
}

bool menu_eye(Ui& ui,
              std::string_view id,
              std::string_view label,
              bool is_on,
              std::string_view tip,
              const Permission& permission) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const Rect& row = slot.rect();
    const Press now = press(ui, ui.path(id), row, permission, tip);
    const Palette& colours = ui.colours();
    const double opacity = now.enabled ? 1.0 : 0.45;
    fill(row, now.hovered || now.focused ? colours.hover : Colour{0}, ui.px(gaps::rounding));
    const float eye = ui.px(mark_width);
    draw_text(ui,
              ui.look().fonts.text,
              {row.x, row.y, eye, row.h},
              faded(is_on ? colours.accent : colours.muted, opacity),
              is_on ? icons::eye : icons::eye_off,
              Align::centre);
    draw_text(ui,
              ui.look().fonts.text,
              {row.x + eye, row.y, row.w - eye - ui.px(8.0F), row.h},
              faded(is_on ? colours.text : colours.muted, opacity),
              label);
    return now.clicked;
}

void menu_line(Ui& ui) {
    const Slot slot(ui, 0.0F, ui.px(9.0F));
    const Rect& row = slot.rect();
    fill({row.x, std::round(row.centre().y), row.w, 1.0F}, ui.colours().line);
}

} // namespace millwright::widgets
