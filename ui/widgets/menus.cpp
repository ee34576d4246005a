#include "ui/widgets/menus.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"

#include <cmath>
#include <string>

namespace millwright::widgets {

namespace {

constexpr float menu_width = 290.0F;

Guard begin_list(Ui& ui, std::string_view id, const std::string& popup) {
    const float pad = ui.px(gaps::tiny);
    ImGui::SetNextWindowSize({ui.px(menu_width), 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
    const bool open = ImGui::BeginPopup(popup.c_str());
    ui.state().places.enter(id);
    if (!open) {
        ImGui::PopStyleVar(2);
        return {ui, [](Ui& with) { with.state().places.leave(); }, false};
    }
    return {ui, [](Ui& with) {
                ImGui::EndPopup();
                ImGui::PopStyleVar(2);
                with.state().places.leave();
            }};
}

} // namespace

Guard menu(Ui& ui, std::string_view id, std::string_view label) {
    const std::string own = ui.path(id);
    const std::string popup = own + "@menu";
    Rect place;
    {
        const float width = std::ceil(text_width(ui.look().fonts.text, label) + ui.px(20.0F));
        const Slot slot(ui, width, ui.px(gaps::row));
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
    if (ImGui::IsPopupOpen(popup.c_str())) {
        ImGui::SetNextWindowPos({place.x, place.bottom() + ui.px(2.0F)});
    }
    return begin_list(ui, id, popup);
}

Guard context_menu(Ui& ui, std::string_view id, const Rect& place) {
    const std::string popup = ui.path(id) + "@menu";
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) && ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect(upper_left(place), lower_right(place))) {
        ImGui::OpenPopup(popup.c_str());
    }
    return begin_list(ui, id, popup);
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
    const float tick = ui.px(26.0F);
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
    if (now.clicked) {
        ImGui::CloseCurrentPopup();
    }
    return now.clicked;
}

void menu_line(Ui& ui) {
    const Slot slot(ui, 0.0F, ui.px(9.0F));
    const Rect& row = slot.rect();
    fill({row.x, std::round(row.centre().y), row.w, 1.0F}, ui.colours().line);
}

} // namespace millwright::widgets
