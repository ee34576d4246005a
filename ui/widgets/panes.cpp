#include "core/base/error.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

constexpr ImGuiWindowFlags pane_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoBringToFrontOnFocus |
                                        ImGuiWindowFlags_NoNavFocus; // ImGui's Ctrl+Tab list shows bare ids

void end_pane(Ui& ui) {
    ImGui::End();
    ui.state().places.leave();
}

/// In a pane that is scrolled the widget that was pressed last stays under the hand, though what is worked
/// out meanwhile takes rows away above it, or so many that the pane could not be scrolled that far.
void hold_in_place(Ui& ui) {
    Ui::State& state = ui.state();
    Ui::State::Anchor& anchor = state.anchor;
    const std::string own = ui.path({});
    const float scrolled = ImGui::GetScrollY();
    const auto in_sight = [](const Seen& seen) { return seen.rect.y - ImGui::GetWindowPos().y; };
    const bool in_list = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (ImGui::GetIO().MouseClicked[0] && !in_list && state.under_mouse.starts_with(own)) {
        const Seen* pressed = scrolled > 0.0F ? state.places.find(state.under_mouse) : nullptr;
        anchor = pressed == nullptr ? Ui::State::Anchor{}
                                    : Ui::State::Anchor{state.under_mouse, in_sight(*pressed), scrolled};
    }
    const Seen* seen = anchor.path.starts_with(own) ? state.places.find(anchor.path) : nullptr;
    if (seen == nullptr) {
        return;
    }
    constexpr float rounding = 1.5F;
    if (std::abs(scrolled - anchor.scrolled) > rounding) { // by a person
        anchor.y = in_sight(*seen);
        anchor.scrolled = scrolled;
    }
    const bool visible = anchor.y >= 0.0F && anchor.y <= ImGui::GetWindowHeight();
    const float wanted = visible ? std::max(scrolled + in_sight(*seen) - anchor.y, 0.0F) : scrolled;
    if (std::abs(wanted - scrolled) > rounding) {
        ImGui::SetScrollY(wanted);
        anchor.scrolled = wanted;
        ui.change_in(0.0);
    }
    const float missing =
        wanted + ImGui::GetWindowHeight() - ImGui::GetStyle().WindowPadding.y - ImGui::GetCursorPosY();
    if (visible && wanted > 0.0F && missing > 1.0F) {
        ImGui::Dummy({1.0F, std::ceil(missing)});
    }
}

void end_scrolled_pane(Ui& ui) {
    hold_in_place(ui);
    end_pane(ui);
}

bool begin_window(Ui& ui,
                  std::string_view id,
                  const Rect& rect,
                  ImGuiWindowFlags flags,
                  ImVec2 padding,
                  std::string_view content = {}) {
    const std::string path = ui.path(id);
    const std::string name = content.empty() ? path : path + "@" + std::string(content);
    ui.state().places.record(path, {rect, true, true, {}});
    ImGui::SetNextWindowPos(upper_left(rect));
    ImGui::SetNextWindowSize({rect.w, rect.h});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    const bool open = ImGui::Begin(name.c_str(), nullptr, flags);
    ImGui::PopStyleVar();
    ui.state().places.enter(id);
    return open;
}

} // namespace

Guard Ui::pane(std::string_view id, const Rect& rect, std::string_view title, std::string_view content) {
    const float pad = px(gaps::pad);
    const ImGuiWindowFlags flags = pane_flags & ~ImGuiWindowFlags_NoScrollbar;
    const bool open = begin_window(*this, id, rect, flags, {pad, pad}, content);
    if (!title.empty()) {
        heading(title);
    }
    return {*this, end_scrolled_pane, open};
}

Guard Ui::bare_pane(std::string_view id, const Rect& rect) {
    const bool open =
        begin_window(*this, id, rect, pane_flags | ImGuiWindowFlags_NoScrollWithMouse, {0.0F, 0.0F});
    return {*this, end_pane, open};
}

Rect Ui::rest() const {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 left = ImGui::GetContentRegionAvail();
    return {at.x, at.y, left.x, left.y};
}

Guard Ui::section(std::string_view id, std::string_view title, bool open_at_first) {
    const std::string own = path(id);
    const auto [memory, is_new] = state_->memory.try_emplace(own, open_at_first ? 1.0 : 0.0);
    {
        const Slot slot(*this, 0.0F, px(gaps::row));
        const Press now = press(*this, own, slot.rect());
        if (now.clicked) {
            memory->second = 1.0 - memory->second;
        }
        const Rect& bar = slot.rect();
        const float icon = px(18.0F);
        const bool open = memory->second > 0.5;
        fill({bar.x, bar.y, bar.w, 1.0F}, colours().line);
        draw_text(*this,
                  look_.fonts.small,
                  {bar.x, bar.y, icon, bar.h},
                  now.hovered ? colours().text : colours().muted,
                  open ? icons::chevron_down : icons::chevron_right);
        draw_text(*this,
                  look_.fonts.strong,
                  {bar.x + icon, bar.y, bar.w - icon, bar.h},
                  now.hovered ? colours().accent : colours().text,
                  title);
    }
    state_->places.enter(id);
    return {*this, [](Ui& ui) { ui.state().places.leave(); }, memory->second > 0.5};
}

Guard Ui::row(int count, float least_width) {
    expects(count > 0, "a row has at least one widget");
    const float gap = px(gaps::small);
    const float room = ImGui::GetContentRegionAvail().x + gap;
    const int fitting =
        least_width > 0.0F ? std::max(static_cast<int>(room / (least_width + gap)), 1) : count;
    const int lines = (count + fitting - 1) / fitting;
    state_->cells.push_back({(count + lines - 1) / lines, 0, count, {}});
    return {*this, [](Ui& ui) { ui.state().cells.pop_back(); }};
}

Guard Ui::label_share(float share) {
    expects(share >= 0.0F && share < 1.0F, "labels leave some width to the fields");
    state_->label_shares.push_back(share);
    return {*this, [](Ui& ui) { ui.state().label_shares.pop_back(); }};
}

Guard Ui::width(float width) {
    expects(width > 0.0F, "a widget has a width");
    state_->widths.push_back(width);
    return {*this, [](Ui& ui) { ui.state().widths.pop_back(); }};
}

Guard Ui::dialog(std::string_view id, std::string_view title, float width) {
    const std::string own = path(id);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * display.x, 0.42F * display.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({width, 0.0F});
    const float pad = 1.5F * px(gaps::pad);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(6.0F));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
    if (!ImGui::IsPopupOpen(own.c_str())) {
        ImGui::OpenPopup(own.c_str());
    }
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
    const bool open = ImGui::BeginPopupModal(own.c_str(), nullptr, flags);
    ImGui::PopStyleVar(3);
    state_->places.enter(id);
    if (!open) {
        return {*this, [](Ui& ui) { ui.state().places.leave(); }, false};
    }
    heading(title);
    return {*this, [](Ui& ui) {
                ImGui::EndPopup();
                ui.state().places.leave();
            }};
}

Guard Ui::permitted(const Permission& permission) {
    state_->permissions.push_back(permission);
    return {*this, [](Ui& ui) { ui.state().permissions.pop_back(); }};
}

void Ui::beside() {
    ImGui::SameLine(0.0F, px(gaps::small));
}

void Ui::move_by(float right, float down) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({at.x + right, at.y + down});
}

void Ui::gap() {
    ImGui::Dummy({1.0F, px(gaps::small)});
}

void Ui::line() {
    const Slot slot(*this, 0.0F, px(gaps::small));
    fill({slot.rect().x, std::round(slot.rect().centre().y), slot.rect().w, 1.0F}, colours().line);
}

} // namespace millwright::widgets
