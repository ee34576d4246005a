#include "ui/widgets/ui.h"

#include "core/base/error.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/edit.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::widgets {

namespace {

constexpr double tip_after = 0.45; // s that the mouse rests before its tip appears
constexpr float tip_width_px = 320.0F;

struct Note {
    Rect widget; ///< that it belongs to
    std::string_view text;
    Colour border = 0;
    Colour colour = 0;
};

float shared_area(const Rect& a, const Rect& b) {
    const float w = std::min(a.right(), b.right()) - std::max(a.x, b.x);
    const float h = std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y);
    return w > 0.0F && h > 0.0F ? w * h : 0.0F;
}

bool holds(const Rect& outer, const Rect& inner) {
    return outer.x <= inner.x && outer.y <= inner.y && outer.right() >= inner.right() &&
           outer.bottom() >= inner.bottom();
}

/// How much a box there would be in the way: each widget under it counts, and much more one to be kept clear.
float obstruction(const Ui& ui, const Ui::State& state, const Rect& box, const Rect& own) {
    constexpr float never = 1000.0F;
    float sum = 0.0F;
    for (const auto& [path, seen] : ui.places().all()) {
        if (seen.visible && seen.enabled && !holds(seen.rect, own) && shared_area(box, seen.rect) > 0.0F) {
            sum += 1.0F;
        }
    }
    for (const std::string& path : state.kept_clear) {
        const auto place = ui.place(path);
        sum += place && shared_area(box, *place) > 0.0F ? never : 0.0F;
    }
    return sum;
}

/// Below the widget; if that hides others, above or beside it, wherever it hides least.
Rect box_place(const Ui& ui, const Ui::State& state, const Rect& own, float w, float h) {
    const float gap = ui.px(4.0F);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const std::array<Point, 4> corners{{{own.x, own.bottom() + gap},
                                        {own.x, own.y - gap - h},
                                        {own.x - gap - w, own.y},
                                        {own.right() + gap, own.y}}};
    Rect best;
    float least = -1.0F;
    for (const Point& corner : corners) {
        const Rect box{std::clamp(corner.x, 0.0F, std::max(0.0F, display.x - w)),
                       std::clamp(corner.y, 0.0F, std::max(0.0F, display.y - h)),
                       w,
                       h};
        const bool over_own = shared_area(box, own) > 0.0F;
        const float hidden = obstruction(ui, state, box, own) + (over_own ? 100.0F : 0.0F);
        if (least < 0.0F || hidden < least) {
            least = hidden;
            best = box;
        }
    }
    return best;
}

/// A box over everything else that takes no input; where it was drawn.
Rect draw_box(const Ui& ui, const Ui::State& state, const Note& note) {
    const ImFont* font = ui.look().fonts.text;
    const float wrap = ui.px(tip_width_px);
    const std::string text = broken_at_blanks(font, note.text, wrap);
    const char* begin = text.data();
    const char* end = begin + text.size();
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e9F, wrap, begin, end);
    const float pad = ui.px(8.0F);
    const Rect box = box_place(ui, state, note.widget, size.x + 2.0F * pad, size.y + 2.0F * pad);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float round = ui.px(gaps::rounding);
    list.AddRectFilled(upper_left(box), lower_right(box), ui.colours().raised, round);
    list.AddRect(upper_left(box), lower_right(box), note.border, round);
    const ImVec2 at{std::round(box.x + pad), std::round(box.y + pad)};
    list.AddText(font, font->FontSize, at, note.colour, begin, end, wrap);
    return box;
}

} // namespace

Ui::Ui(Look look) : look_(look), state_(std::make_unique<State>()) {
    expects(look.fonts.text != nullptr && look.fonts.strong != nullptr && look.fonts.small != nullptr &&
                look.fonts.mono != nullptr && look.fonts.digits != nullptr,
            "the workbench has its fonts");
}

Ui::~Ui() = default;

void Ui::keep_keys_from_widgets() {
    ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard; // begin_frame() gives them back
}

void Ui::begin_frame() {
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigInputTextCursorBlink = false; // an idle window is not drawn again
    show_keyboard_on_tab();
    ImGui::GetBackgroundDrawList()->AddRectFilled({0.0F, 0.0F}, io.DisplaySize, colours().window);
    state_->places.clear();
    state_->under_mouse_before = std::exchange(state_->under_mouse, {});
    state_->hints.clear();
    state_->kept_clear.clear();
    state_->keys_claimed = false;
    state_->typing_at_begin = text_field_active();
    keep_early_text(*state_);
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
            const Rect box = draw_box(*this, *state_, {tip.rect, tip.text, colours().line, colours().text});
            // Above all panes. Its reason is what it says, as that of a greyed-out widget is.
            state_->places.record(path("tip"), {box, true, true, tip.text});
        } else {
            change_in(tip_after - rested);
        }
    }
    for (const State::Hint& hint : state_->hints) {
        (void)draw_box(*this, *state_, {hint.rect, hint.reason, colours().danger, colours().danger});
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

bool Ui::was_typing() const {
    return state_->keys_claimed || state_->typing_at_begin || text_field_active() ||
           ImGui::GetFrameCount() <= state_->edit.kept_until;
}

void Ui::claim_keys() {
    state_->keys_claimed = true;
}

bool Ui::keys_claimed() const {
    return state_->keys_claimed;
}

void Ui::keep_clear(std::string_view path) {
    state_->kept_clear.emplace_back(path);
}

bool Ui::escape_pressed() const {
    return key_pressed(ImGuiKey_Escape);
}

bool Ui::enter_pressed() const {
    return key_pressed(ImGuiKey_Enter) || keypad_enter_pressed();
}

void Ui::focus_pane(std::string_view path) {
    ImGui::SetWindowFocus(std::string(path).c_str());
}

void Ui::focus_field(std::string_view path) {
    constexpr int soon = 5; // frames: its pane may have to come first
    constexpr int called_it = 1;
    state_->early = {};
    await_keyboard(*state_, soon, called_it);
    state_->edit = {.path = std::string(path),
                    .text = {},
                    .initial = {},
                    .called = true,
                    .kept_until = ImGui::GetFrameCount() + soon};
}

Guard Ui::enter_goes_on() {
    state_->chain = {.open = true};
    return {*this, [](Ui& ui) { ui.state_->chain = {}; }};
}

Guard Ui::scope(std::string_view id) {
    state_->places.enter(id);
    return {*this, [](Ui& ui) { ui.state_->places.leave(); }};
}

std::string Ui::path(std::string_view id) const {
    return state_->places.path(id);
}

void Ui::record(std::string_view id, const Rect& rect, bool enabled, std::string reason) {
    record_at(*this, path(id), rect, enabled, std::move(reason));
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
