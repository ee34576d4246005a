#include "ui/widgets/internal/scrub.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

constexpr float pixels_per_step = 4.0F;

/// Kept by path while the label is held.
enum class Stage { idle, dragging, given_up };

double dragged_value(const Ui& ui, const ScrubView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const double size = io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0;
    const float along = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x;
    const double steps = std::trunc(static_cast<double>(along / ui.px(pixels_per_step)));
    const double whole = std::pow(10.0, view.info.decimals);
    const double wanted = view.value + steps * size * view.step;
    return std::clamp(std::round(wanted * whole) / whole, view.info.min, view.info.max);
}

} // namespace

Scrubbed scrub(Ui& ui, const ScrubView& view) {
    const Press now = press(ui, view.path + ".label", view.label, view.permission, {}, Reach::mouse);
    double& kept = ui.state().memory[view.path + "@scrub"];
    const auto stage = static_cast<Stage>(static_cast<int>(kept));
    if (now.hovered || now.held) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
    const bool moved =
        std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x) >= ui.px(pixels_per_step);
    const auto keep = [&kept](Stage next) { kept = static_cast<double>(next); };
    if (!now.held) {
        keep(Stage::idle);
        const bool let_go = stage == Stage::dragging && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
        return let_go ? Scrubbed{std::nullopt, dragged_value(ui, view)} : Scrubbed{};
    }
    if (key_pressed(ImGuiKey_Escape)) {
        keep(Stage::given_up);
        return {};
    }
    if (stage == Stage::given_up || (stage == Stage::idle && !moved)) {
        return {};
    }
    keep(Stage::dragging);
    return {dragged_value(ui, view), std::nullopt};
}

} // namespace millwright::widgets
