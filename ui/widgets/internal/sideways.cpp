#include "ui/widgets/internal/sideways.h"

#include "ui/widgets/internal/scroll_bar.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

constexpr double pixels_per_notch = 60.0;

struct SidewaysState {
    double& left;
    double& width;
    double& room;

    [[nodiscard]] bool too_wide() const { return width > room + 0.5; }
    void stay_inside() const { left = std::clamp(left, 0.0, std::max(0.0, width - room)); }
};

SidewaysState state_of(Ui& ui, const std::string& path) {
    auto& memory = ui.state().memory;
    return {memory[path + "@left"], memory[path + "@wide"], memory[path + "@room"]};
}

} // namespace

Sideways::Sideways(Ui& ui, const std::string& path, Rect& box) : ui_(ui), path_(path) {
    const SidewaysState state = state_of(ui, path);
    if (!state.too_wide()) {
        state.left = 0.0;
        return;
    }
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(upper_left(box), lower_right(box))) {
        const double notches = static_cast<double>(io.MouseWheelH + (io.KeyShift ? io.MouseWheel : 0.0F));
        state.left -= static_cast<double>(ui.px(1.0F)) * pixels_per_notch * notches;
    }
    const float thickness = ui.px(scroll_bar_width);
    box.h -= thickness;
    scroll_bar(ui,
               path + "/sideways",
               {{box.x, box.bottom(), box.w - thickness, thickness}, state.room, state.width, true},
               state.left);
    state.stay_inside();
}

float Sideways::strip(Ui& ui, const std::string& path) {
    return state_of(ui, path).too_wide() ? ui.px(scroll_bar_width) : 0.0F;
}

float Sideways::shift() const {
    return std::round(static_cast<float>(state_of(ui_, path_).left));
}

void Sideways::content(float width, float room) {
    const SidewaysState state = state_of(ui_, path_);
    const bool before = state.too_wide();
    state.width = static_cast<double>(width);
    state.room = static_cast<double>(room);
    state.stay_inside();
    if (before != state.too_wide()) {
        ui_.change_in(0.0);
    }
}

void Sideways::bring_into_sight(float from, float to) {
    const SidewaysState state = state_of(ui_, path_);
    const auto begin = static_cast<double>(from), end = static_cast<double>(to);
    if (begin < state.left || end > state.left + state.room) {
        state.left = end <= state.room ? 0.0 : begin - 0.3 * state.room;
    }
    state.stay_inside();
}

} // namespace millwright::widgets
