#include "ui/widgets/internal/rows.h"

#include "ui/widgets/internal/scroll_bar.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

constexpr double rows_per_notch = 3.0;

double& scroll_of(Ui& ui, const std::string& path) {
    return ui.state().memory[path + "@top"];
}

void take_wheel_and_keys(const Ui& ui, const Rect& box, double& top, double in_sight) {
    if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect(upper_left(box), lower_right(box))) {
        return;
    }
    if (!ImGui::GetIO().KeyShift) { // else it goes sideways
        top -= rows_per_notch * static_cast<double>(ImGui::GetIO().MouseWheel);
    }
    if (ui.was_typing()) {
        return;
    }
    top += key_pressed(ImGuiKey_PageDown) ? in_sight : 0.0;
    top -= key_pressed(ImGuiKey_PageUp) ? in_sight : 0.0;
}

} // namespace

Rows::Rows(Ui& ui, const std::string& path, const Rect& box, std::ptrdiff_t count, float row_height)
    : inside_(box), row_height_(row_height) {
    double& top = scroll_of(ui, path);
    const double in_sight = static_cast<double>(box.h / row_height);
    const auto rows = static_cast<double>(count);
    scrolls_ = in_sight < rows;
    if (scrolls_) {
        const float width = ui.px(scroll_bar_width);
        inside_.w -= width;
        take_wheel_and_keys(ui, box, top, in_sight);
        scroll_bar(ui, path + "/scroll", {{inside_.right(), box.y, width, box.h}, in_sight, rows}, top);
    }
    top = std::clamp(top, 0.0, std::max(0.0, rows - in_sight));
    top_ = top;
    first_ = static_cast<std::ptrdiff_t>(std::floor(top));
    end_ = std::min(count, static_cast<std::ptrdiff_t>(std::ceil(top + in_sight)));
    ImGui::PushClipRect(upper_left(inside_), lower_right(inside_), true);
}

Rows::~Rows() {
    ImGui::PopClipRect();
}

Rect Rows::row(std::ptrdiff_t index) const {
    const double below_top = static_cast<double>(index) - top_;
    const float y = inside_.y + std::round(static_cast<float>(below_top) * row_height_);
    return {inside_.x, y, inside_.w, row_height_};
}

Rect Rows::row_in_sight(std::ptrdiff_t index) const {
    const Rect whole = row(index);
    const float y = std::max(whole.y, inside_.y);
    return {whole.x, y, whole.w, std::min(whole.bottom(), inside_.bottom()) - y};
}

void bring_into_sight(Ui& ui, const std::string& path, std::ptrdiff_t index, float rows_in_sight) {
    double& top = scroll_of(ui, path);
    const auto row = static_cast<double>(index);
    const auto in_sight = static_cast<double>(rows_in_sight);
    if (row < top || row + 1.0 > top + in_sight) {
        top = std::floor(row - 0.5 * in_sight);
    }
}

} // namespace millwright::widgets
