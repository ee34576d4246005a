#include "ui/widgets/internal/scrolling.h"

#include <algorithm>
#include <cmath>

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
