#include "ui/viewport/internal/axis_gizmo.h"

#include "ui/render/view_colors.h"
#include "ui/viewport/internal/view_controls.h"

#include <glm/vec2.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::viewport {

namespace {

using render::StandardView;

// Pixels at scale 1.
constexpr float arm = 30.0F;
constexpr float ball = 8.5F;

struct End {
    int axis = 0;
    bool positive = true;
    StandardView side = StandardView::iso;
    glm::vec2 place{};  ///< pixels from the middle, y downwards
    float depth = 0.0F; ///< towards the eye
};

std::array<End, 6> ends(const render::View& view, float length) {
    std::array<End, 6> all = {{{0, true, StandardView::right},
                               {1, true, StandardView::back},
                               {2, true, StandardView::top},
                               {0, false, StandardView::left},
                               {1, false, StandardView::front},
                               {2, false, StandardView::bottom}}};
    for (End& end : all) {
        const glm::vec3 seen = glm::vec3(view.view[end.axis]) * (end.positive ? length : -length);
        end.place = {seen.x, -seen.y};
        end.depth = seen.z;
    }
    std::ranges::sort(all, {}, &End::depth);
    return all;
}

glm::vec3 color_of(const End& end, const render::ViewColors& colors) {
    return std::array{colors.axis_x, colors.axis_y, colors.axis_z}[static_cast<std::size_t>(end.axis)];
}

void draw_end(widgets::Ui& ui, const Pane& pane, ImVec2 middle, const End& end, bool hovered) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const glm::vec3 color = color_of(end, pane.colors);
    const ImVec2 at = {middle.x + end.place.x, middle.y + end.place.y};
    const float radius = ui.px(ball);
    if (end.positive) {
        list.AddLine(middle, at, to_colour(color), ui.px(2.0F));
        list.AddCircleFilled(at, radius, to_colour(color));
    } else {
        list.AddCircleFilled(
            at, 0.85F * radius, to_colour(glm::mix(pane.colors.background_top, color, 0.35F)));
        list.AddCircle(at, 0.85F * radius, to_colour(color, 0.9), 0, ui.px(1.2F));
    }
    if (hovered) {
        list.AddCircle(at, radius + ui.px(1.5F), to_colour(render::ink(pane.colors)), 0, ui.px(1.5F));
    }
    if (end.positive || hovered) {
        const std::string text = std::string(end.positive ? "" : "-") + "XYZ"[end.axis];
        const ImFont* font = ui.look().fonts.small;
        const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0.0F, text.c_str());
        list.AddText(font,
                     font->FontSize,
                     {std::round(at.x - 0.5F * size.x), std::round(at.y - 0.5F * size.y)},
                     to_colour(end.positive ? pane.colors.neutral[0] : render::ink(pane.colors)),
                     text.c_str());
    }
}

} // namespace

std::optional<StandardView> axis_gizmo(widgets::Ui& ui, const Pane& pane) {
    const widgets::Rect place = view_controls(ui, pane.rect, 0).axes;
    const float size = place.w;
    const ImVec2 middle = {place.centre().x, place.centre().y};
    ImGui::SetCursorScreenPos({place.x, place.y});
    ImGui::PushAllowKeyboardFocus(false); // Tab does not stop here
    const bool clicked = ImGui::InvisibleButton(ui.path("axes").c_str(), {size, size});
    ImGui::PopAllowKeyboardFocus();
    const bool hovered = ImGui::IsItemHovered();
    ui.record("axes", place);
    if (hovered) {
        ImGui::GetWindowDrawList()->AddCircleFilled(
            middle, 0.5F * size, to_colour(render::ink(pane.colors), 0.08));
    }
    const std::array<End, 6> all = ends(pane.view, ui.px(arm));
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const End* under = nullptr;
    for (const End& end : all) {
        const float away = std::hypot(mouse.x - middle.x - end.place.x, mouse.y - middle.y - end.place.y);
        if (hovered && away <= ui.px(ball + 2.0F)) {
            under = &end; // of two the one in front comes later
        }
    }
    for (const End& end : all) {
        draw_end(ui, pane, middle, end, &end == under);
    }
    return clicked && under != nullptr ? std::optional(under->side) : std::nullopt;
}

} // namespace millwright::viewport
