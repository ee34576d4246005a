#include "ui/widgets/splitter.h"

#include "ui/widgets/internal/draw.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

constexpr float grab_px = 3.0F; // more than the bar shows, on each side

bool is_upright(SizeOf side) {
    return side == SizeOf::left || side == SizeOf::right;
}

Rect grab_area(const Ui& ui, const SplitterView& view) {
    const float more = ui.px(grab_px);
    const Rect& bar = view.bar;
    return is_upright(view.side) ? Rect{bar.x - more, bar.y, bar.w + 2.0F * more, bar.h}
                                 : Rect{bar.x, bar.y - more, bar.w, bar.h + 2.0F * more};
}

float moved_size(Ui& ui, const std::string& path, const SplitterView& view) {
    double& at_start = ui.state().memory[path + "@size"];
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        at_start = static_cast<double>(view.size);
    }
    const ImVec2 drag = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
    const float along = is_upright(view.side) ? drag.x : drag.y;
    const bool grows = view.side == SizeOf::left || view.side == SizeOf::above;
    const float wanted = static_cast<float>(at_start) + (grows ? along : -along);
    return std::round(std::clamp(wanted, view.min, std::max(view.min, view.max)));
}

} // namespace

std::optional<float> splitter(Ui& ui, std::string_view id, const SplitterView& view) {
    const std::string own = ui.path(id);
    const Rect grab = grab_area(ui, view);
    ImGui::SetNextWindowPos(upper_left(grab));
    ImGui::SetNextWindowSize({grab.w, grab.h});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                       ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    ImGui::Begin(own.c_str(), nullptr, flags);
    const Press now = press(ui, own, grab, {}, {}, Reach::mouse);
    if (now.hovered || now.held) {
        ImGui::SetMouseCursor(is_upright(view.side) ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    }
    const bool lit = now.hovered || now.held;
    fill(view.bar, lit ? ui.colours().accent : ui.colours().window);
    ImGui::End();
    ImGui::PopStyleVar(2);
    if (!now.held) {
        return std::nullopt;
    }
    const float size = moved_size(ui, own, view);
    return std::abs(size - view.size) > 0.0F ? std::optional(size) : std::nullopt;
}

} // namespace millwright::widgets
