#include "ui/widgets/internal/early_text.h"

#include "ui/widgets/internal/imgui_inside.h"

#include <imgui.h>

#include <algorithm>

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

} // namespace millwright::widgets
