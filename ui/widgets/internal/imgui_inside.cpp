#include "ui/widgets/internal/imgui_inside.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace millwright::widgets {

TabStop::TabStop(bool is_one) {
#if IMGUI_VERSION_NUM >= 18700
    ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, !is_one); // without it Tab stops at every item
#else
    ImGui::PushItemFlag(ImGuiItemFlags_Inputable, is_one); // without it Tab stops at text fields alone
#endif
}

TabStop::~TabStop() {
    ImGui::PopItemFlag();
}

void show_keyboard_on_tab() {
    ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const bool keyboard_on = (imgui.IO.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0;
    if (!keyboard_on || !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab))) {
        return;
    }
#if IMGUI_VERSION_NUM < 18700
    const bool stands_somewhere = imgui.NavId != 0 && !imgui.NavDisableHighlight && imgui.ActiveId == 0;
    if (stands_somewhere) { // ImGui would stay there, since nothing is being typed into
        imgui.NavTabbingDir = imgui.IO.KeyShift ? -1 : +1;
    }
#endif
    imgui.NavDisableHighlight = false;
}

void focus_next_item() {
#if IMGUI_VERSION_NUM >= 18700
    ImGuiContext& imgui = *ImGui::GetCurrentContext();
    imgui.NavFocusScopeId = imgui.CurrentFocusScopeId; // 1.90.1 looks for the item only where the keyboard is
#endif
    ImGui::SetKeyboardFocusHere();
}

void overlaid_button(const std::string& id, const Rect& place, int buttons) {
    const TabStop none(false);
    const ImVec2 size(std::max(place.w, 1.0F), std::max(place.h, 1.0F));
    ImGui::SetCursorScreenPos({place.x, place.y});
#if IMGUI_VERSION_NUM >= 18970
    ImGui::SetNextItemAllowOverlap();
    ImGui::InvisibleButton(id.c_str(), size, buttons);
#else
    ImGui::InvisibleButton(id.c_str(), size, buttons);
    ImGui::SetItemAllowOverlap();
#endif
}

void close_lists() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    const auto is_list = [&g](int level) {
        const ImGuiWindow* window = g.BeginPopupStack[level].Window;
        return window != nullptr && (window->Flags & ImGuiWindowFlags_Modal) == 0;
    };
    int level = g.BeginPopupStack.Size - 1;
    while (level > 0 && is_list(level - 1)) {
        --level;
    }
    if (level >= 0) {
        ImGui::ClosePopupToLevel(level, true);
    }
}

void keep_wheel() {
    ImGui::SetItemUsingMouseWheel();
}

bool keypad_enter_pressed() {
#if IMGUI_VERSION_NUM >= 18700
    constexpr ImGuiKey key = ImGuiKey_KeypadEnter;
#else
    constexpr ImGuiKey key = ImGuiKey_KeyPadEnter;
#endif
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

std::optional<Rect> dialog_place() {
    const ImGuiWindow* dialog = ImGui::GetTopMostPopupModal();
    if (dialog == nullptr) {
        return std::nullopt;
    }
    return Rect{dialog->Pos.x, dialog->Pos.y, dialog->Size.x, dialog->Size.y};
}

bool text_field_active() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    return g.ActiveId != 0 && g.ActiveId == g.InputTextState.ID;
}

} // namespace millwright::widgets
