#include "ui/widgets/ui.h"

#include "core/base/error.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::widgets {

namespace {

constexpr double tip_after = 0.45; // s that the mouse rests before its tip appears
constexpr float tip_width_px = 320.0F;

/// A box over everything else that takes no input, its upper left corner near `at`, kept inside the window.
void draw_box(const Ui& ui, Point at, Colour border, Colour colour, std::string_view text) {
    const ImFont* font = ui.look().fonts.text;
    const float wrap = ui.px(tip_width_px);
    const ImVec2 size =
        font->CalcTextSizeA(font->FontSize, 1e9F, wrap, text.data(), text.data() + text.size());
    const float pad = ui.px(8.0F);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const Rect box{std::clamp(at.x, 0.0F, std::max(0.0F, display.x - size.x - 2.0F * pad)),
                   std::clamp(at.y, 0.0F, std::max(0.0F, display.y - size.y - 2.0F * pad)),
                   size.x + 2.0F * pad,
                   size.y + 2.0F * pad};
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float round = ui.px(gaps::rounding);
    list.AddRectFilled(upper_left(box), lower_right(box), ui.colours().raised, round);
    list.AddRect(upper_left(box), lower_right(box), border, round);
    list.AddText(font,
                 font->FontSize,
                 {std::round(box.x + pad), std::round(box.y + pad)},
                 colour,
                 text.data(),
                 text.data() + text.size(),
                 wrap);
}

} // namespace

Ui::Ui(Look look) : look_(look), state_(std::make_unique<State>()) {
    expects(look.fonts.text != nullptr && look.fonts.strong != nullptr && look.fonts.small != nullptr &&
                look.fonts.mono != nullptr && look.fonts.digits != nullptr,
            "the workbench has its fonts");
}

Ui::~Ui() = default;

void Ui::begin_frame() {
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigInputTextCursorBlink = false; // an idle window is not drawn again
    show_keyboard_on_tab();
    ImGui::GetBackgroundDrawList()->AddRectFilled({0.0F, 0.0F}, io.DisplaySize, colours().window);
    state_->places.clear();
    state_->under_mouse_before = std::exchange(state_->under_mouse, {});
    state_->hints.clear();
    state_->cut_texts.clear();
    state_->cells.clear();
    state_->widths.clear();
    state_->label_shares.clear();
    state_->permissions.clear();
    state_->change_at.reset();
}

void Ui::end_frame() {
    const State::Tip& tip = state_->tip;
    if (tip.frame == ImGui::GetFrameCount() && (tip.at_once || !ImGui::IsAnyMouseDown())) {
        const double rested = tip.at_once ? tip_after : ImGui::GetTime() - tip.since;
        if (rested >= tip_after) {
            draw_box(
                *this, {tip.rect.x, tip.rect.bottom() + px(4.0F)}, colours().line, colours().text, tip.text);
        } else {
            change_in(tip_after - rested);
        }
    }
    for (const State::Hint& hint : state_->hints) {
        draw_box(*this,
                 {hint.rect.x, hint.rect.bottom() + px(3.0F)},
                 colours().danger,
                 colours().danger,
                 hint.reason);
    }
}

std::optional<double> Ui::next_change() const {
    if (!state_->change_at) {
        return std::nullopt;
    }
    return std::max(0.0, *state_->change_at - ImGui::GetTime());
}

void Ui::change_in(double seconds) {
    const double at = ImGui::GetTime() + seconds;
    state_->change_at = state_->change_at ? std::min(*state_->change_at, at) : at;
}

bool Ui::is_typing() const {
    return ImGui::GetIO().WantTextInput;
}

bool Ui::escape_pressed() const {
    return key_pressed(ImGuiKey_Escape);
}

bool Ui::enter_pressed() const {
    return key_pressed(ImGuiKey_Enter) || key_pressed(ImGuiKey_KeyPadEnter);
}

void Ui::focus_pane(std::string_view path) {
    ImGui::SetWindowFocus(std::string(path).c_str());
}

Guard Ui::scope(std::string_view id) {
    state_->places.enter(id);
    return {*this, [](Ui& ui) { ui.state_->places.leave(); }};
}

std::string Ui::path(std::string_view id) const {
    return state_->places.path(id);
}

void Ui::record(std::string_view id, const Rect& rect, bool enabled, std::string reason) {
    state_->places.record(path(id), {rect, enabled, true, std::move(reason)});
}

std::optional<Rect> Ui::place(std::string_view path) const {
    const Seen* seen = state_->places.find(path);
    return seen == nullptr ? std::nullopt : std::optional(seen->rect);
}

const Places& Ui::places() const {
    return state_->places;
}

std::span<const std::string> Ui::cut_texts() const {
    return state_->cut_texts;
}

} // namespace millwright::widgets
