#include "ui/widgets/internal/edit.h"

#include "ui/widgets/internal/imgui_inside.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::widgets {

namespace {

/// No other field gets what waits, no key is a shortcut, and Enter comes a frame after what was typed.
void take_characters(Ui::State::EarlyText& early, int left_out) {
    ImGui::GetIO().WantTextInput = true;
    auto& typed = ImGui::GetIO().InputQueueCharacters;
    early.characters.insert(
        early.characters.end(), typed.begin() + std::min(typed.Size, left_out), typed.end());
    typed.resize(0);
}

} // namespace

void await_keyboard(Ui::State& state, int frames, int left_out) {
    state.early.until = ImGui::GetFrameCount() + frames;
    take_characters(state.early, left_out);
}

void keep_early_text(Ui::State& state) {
    Ui::State::EarlyText& early = state.early;
    if (early.until < 0) {
        return;
    }
    take_characters(early, 0);
    if (text_field_active()) {
        auto& typed = ImGui::GetIO().InputQueueCharacters;
        std::ranges::for_each(early.characters, [&typed](ImWchar character) { typed.push_back(character); });
        early = {};
    } else if (ImGui::GetFrameCount() > early.until) {
        early = {};
    }
}

namespace {

constexpr double refusal_shown = 6.0; // s
constexpr int frames_to_refocus = 3;  // ImGui gives the keyboard back one frame later

struct Parts {
    Rect typing;
    Rect mark;
    Rect unit;
};

/// Where the pieces of the box are, from left to right: mark, text, room, unit.
Parts parts(const Ui& ui, const EditBox& box) {
    const ImFont* small = ui.look().fonts.text;
    const float pad = ui.px(7.0F);
    const float mark = box.mark.empty() ? 0.0F : text_width(small, box.mark) + ui.px(6.0F);
    const float unit = box.unit.empty() ? 0.0F : text_width(small, box.unit) + ui.px(6.0F);
    const Rect& all = box.rect;
    return {.typing = {all.x + pad + mark, all.y, all.w - 2.0F * pad - mark - unit - box.room, all.h},
            .mark = {all.x + pad, all.y, mark, all.h},
            .unit = {all.right() - pad - unit, all.y, unit, all.h}};
}

/// Up, down and Tab inside the box.
int on_key(ImGuiInputTextCallbackData* data) {
    const EditBox& box = *static_cast<const EditBox*>(data->UserData);
    const std::string_view text(data->Buf, static_cast<std::size_t>(data->BufTextLen));
    const bool completes = data->EventFlag == ImGuiInputTextFlags_CallbackCompletion;
    std::string wanted;
    if (completes) {
        wanted = box.completed(text);
    } else {
        const ImGuiIO& io = ImGui::GetIO();
        const double size = io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0;
        wanted = box.stepped(text, data->EventKey == ImGuiKey_UpArrow ? size : -size);
    }
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, wanted.c_str());
    if (!completes) {
        data->SelectAll();
    }
    return 0;
}

struct Typed {
    std::string text;
    bool activated = false;
    bool active = false;
    bool left = false; ///< the keyboard went elsewhere in this frame
    bool entered = false;
};

Typed type_into(Ui& ui, const EditBox& box, const Rect& typing, std::string text) {
    ImFont* font = ImGui::GetFont();
    for (ImFont* known : {ui.look().fonts.text, ui.look().fonts.mono}) {
        font = known == box.font ? known : font;
    }
    ImGui::PushFont(font);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, 0U);
    ImGui::PushStyleColor(ImGuiCol_NavHighlight, 0U); // the whole box gets the ring instead
    const float pad_y = std::max(0.0F, std::floor(0.5F * (typing.h - font->FontSize)));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, pad_y});
    ImGui::SetCursorScreenPos(upper_left(typing));
    ImGui::SetNextItemWidth(std::max(typing.w, 1.0F));
    ImGuiInputTextFlags flags = ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue;
    ImGuiInputTextCallback callback = nullptr;
    EditBox answering = box; // ImGui wants what it gives back to be changeable
    if (box.stepped || box.completed) {
        flags |= box.stepped ? ImGuiInputTextFlags_CallbackHistory : 0;
        flags |= box.completed ? ImGuiInputTextFlags_CallbackCompletion : 0;
        callback = on_key;
    }
    Typed typed;
    Ui::State::Edit& edit = ui.state().edit;
    if (std::exchange(ui.state().chain.goes_on, false)) {
        edit = {.path = box.path, .text = {}, .initial = {}, .called = true};
    }
    if (edit.called && edit.path == box.path) {
        edit = {.path = box.path,
                .text = text,
                .initial = text,
                .called = false,
                .kept_until = ImGui::GetFrameCount() + frames_to_refocus};
        await_keyboard(ui.state(), frames_to_refocus);
        focus_next_item();
    }
    const std::string id = "##" + box.path;
    typed.entered = ImGui::InputText(id.c_str(), &text, flags, callback, &answering);
    typed.activated = ImGui::IsItemActivated();
    typed.active = ImGui::IsItemActive();
    typed.left = ImGui::IsItemDeactivated();
    typed.text = std::move(text);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
    ImGui::PopFont();
    return typed;
}

void refuse(Ui& ui, const std::string& path, std::string reason) {
    ui.state().refusals[path] = {std::move(reason), ImGui::GetTime() + refusal_shown};
}

/// Enter took the keyboard away from the box that was drawn last.
void take_keyboard_again(Ui& ui) {
    ui.state().edit.kept_until = ImGui::GetFrameCount() + frames_to_refocus;
    await_keyboard(ui.state(), frames_to_refocus);
    ImGui::SetKeyboardFocusHere(-1);
}

/// The keyboard left the box: commit, refuse or revert.
std::optional<std::string> finish(Ui& ui, const EditBox& box, const Typed& typed) {
    Ui::State::Edit& edit = ui.state().edit;
    const std::string text = typed.text;
    const bool reverted = key_pressed(ImGuiKey_Escape) || (box.enter_only && !typed.entered);
    const bool changed = text != edit.initial;
    const std::string reason = reverted || !changed ? std::string() : box.refusal(text);
    if (!reason.empty()) {
        refuse(ui, box.path, reason);
        if (typed.entered) {
            edit.text = text;
            take_keyboard_again(ui);
            return std::nullopt;
        }
        if (box.keeps_refused) {
            ui.state().drafts[box.path] = text;
        }
    } else {
        ui.state().refusals.erase(box.path);
        ui.state().drafts.erase(box.path);
    }
    edit = {};
    ui.state().chain.goes_on = ui.state().chain.open && typed.entered && reason.empty();
    if (box.asks_again && typed.entered && reason.empty()) {
        edit = {.path = box.path, .text = text, .initial = text};
        take_keyboard_again(ui);
        return text;
    }
    if (box.enter_only && typed.entered) {
        edit.path = box.path;
        take_keyboard_again(ui);
    }
    return reason.empty() && changed && !reverted ? std::optional(text) : std::nullopt;
}

std::optional<std::string> follow_typing(Ui& ui, const EditBox& box, const Typed& typed) {
    Ui::State::Edit& edit = ui.state().edit;
    if (typed.activated && edit.path != box.path) {
        edit = {.path = box.path, .text = typed.text, .initial = std::string(box.shown)};
    }
    if (edit.path != box.path) {
        return std::nullopt;
    }
    if (typed.left) {
        return finish(ui, box, typed);
    }
    if (typed.active) {
        edit.text = typed.text;
        edit.kept_until = -1;
        const std::string reason = edit.text == edit.initial ? std::string() : box.refusal(edit.text);
        if (reason.empty()) {
            ui.state().refusals.erase(box.path);
        } else {
            refuse(ui, box.path, reason);
        }
    } else if (ImGui::GetFrameCount() > edit.kept_until) {
        edit = {};
    }
    return std::nullopt;
}

std::string text_now(Ui& ui, const EditBox& box) {
    const Ui::State& state = ui.state();
    if (state.edit.path == box.path && !state.edit.called) {
        return state.edit.text;
    }
    const auto draft = state.drafts.find(box.path);
    return draft == state.drafts.end() ? std::string(box.shown) : draft->second;
}

/// The reason that stands at this box now, if any; what is refused for good stays as long as its text.
std::string reason_now(Ui& ui, const EditBox& box) {
    auto& refusals = ui.state().refusals;
    const auto refusal = refusals.find(box.path);
    if (refusal == refusals.end()) {
        return {};
    }
    const bool stays = ui.state().drafts.contains(box.path) || ui.state().edit.path == box.path;
    if (!stays && ImGui::GetTime() > refusal->second.until) {
        refusals.erase(refusal);
        return {};
    }
    if (!stays) {
        ui.change_in(refusal->second.until - ImGui::GetTime());
    }
    return refusal->second.reason;
}

} // namespace

std::optional<std::string> edit_box(Ui& ui, const EditBox& box) {
    const Permission& permission = effective(ui, box.permission);
    const Palette& colours = ui.colours();
    const Parts part = parts(ui, box);
    const double opacity = permission.allowed ? 1.0 : 0.45;
    const bool hovered = permission.allowed &&
                         ImGui::IsMouseHoveringRect(upper_left(box.rect), lower_right(box.rect)) &&
                         ImGui::IsWindowHovered();
    if (hovered) {
        ui.state().under_mouse = box.path;
    }
    const float round = ui.px(gaps::rounding);
    fill(box.rect, faded(colours.field, opacity), round);

    ImGui::BeginDisabled(!permission.allowed);
    const Typed typed = type_into(ui, box, part.typing, text_now(ui, box));
    const bool focused = typed.active || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible);
    const std::optional<std::string> committed = follow_typing(ui, box, typed);
    ImGui::EndDisabled();

    if (box.stepped && !typed.active && text_width(box.font, typed.text) > part.typing.w) {
        ui.state().cut_texts.push_back(typed.text); // a number of which one sees only the first digits
    }
    draw_text(ui, ui.look().fonts.text, part.mark, faded(box.mark_colour, opacity), box.mark);
    draw_text(ui, ui.look().fonts.text, part.unit, faded(colours.muted, opacity), box.unit, Align::right);
    const std::string reason = permission.allowed ? reason_now(ui, box) : permission.reason;
    const bool is_refused = permission.allowed && !reason.empty();
    const Colour border = is_refused ? colours.danger
                          : focused  ? colours.accent
                          : hovered  ? colours.muted
                                     : colours.line;
    outline(box.rect, faded(border, opacity), round, focused || is_refused ? ui.px(1.5F) : 1.0F);
    record_at(ui, box.path, box.rect, permission.allowed, reason);
    if (is_refused) {
        ui.state().hints.push_back({box.rect, reason});
    } else if (!typed.active) {
        offer_tip(ui, box.path, box.rect, permission.allowed ? box.tip : std::string_view(permission.reason));
    }
    return committed;
}

} // namespace millwright::widgets
