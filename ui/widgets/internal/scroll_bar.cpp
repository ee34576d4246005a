#include "ui/widgets/internal/scroll_bar.h"

#include <algorithm>

namespace millwright::widgets {

void scroll_bar(Ui& ui, const std::string& path, const ScrollBar& bar, double& first) {
    const Rect& place = bar.place;
    const float length = bar.lying ? place.w : place.h;
    const float thickness = bar.lying ? place.h : place.w;
    const float begin = bar.lying ? place.x : place.y;
    const double share = std::min(1.0, bar.in_sight / bar.whole);
    const float grip = std::min(std::max(ui.px(20.0F), length * static_cast<float>(share)), length);
    const double most = bar.whole - bar.in_sight;
    const double travel = static_cast<double>(length - grip);
    const auto grip_at = [&] {
        return begin + static_cast<float>(travel * std::clamp(first / most, 0.0, 1.0));
    };
    const Press now = press(ui, path, place, {}, {}, Reach::mouse);
    double& taken = ui.state().memory[path + "@taken"];
    if (now.held && travel > 0.0) {
        const ImVec2 at = ImGui::GetIO().MousePos;
        const float mouse = bar.lying ? at.x : at.y;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
            const bool on_grip = mouse >= grip_at() && mouse < grip_at() + grip;
            taken = static_cast<double>(on_grip ? mouse - grip_at() : 0.5F * grip);
        }
        first = most * std::clamp((static_cast<double>(mouse - begin) - taken) / travel, 0.0, 1.0);
    }
    const Colour colour = faded(ui.colours().muted, now.held ? 0.8 : now.hovered ? 0.6 : 0.35);
    const float in = ui.px(2.0F);
    const float inside = thickness - 2.0F * in;
    const Rect shown =
        bar.lying ? Rect{grip_at(), place.y + in, grip, inside} : Rect{place.x + in, grip_at(), inside, grip};
    fill(shown, colour, 0.5F * inside);
}

} // namespace millwright::widgets
