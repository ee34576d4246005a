#include "ui/viewport/internal/overlay.h"

#include "core/arm/arm_forward.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/render/convert.h"
#include "ui/render/view_colors.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/stock_sight.h"
#include "ui/widgets/canvas.h"

#include <glm/geometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::viewport {

namespace {

using widgets::Point;
using widgets::Rect;

// Pixels at scale 1.
constexpr float label_ground = 6.0F; // beyond a label's text
constexpr float label_above = 23.0F;
constexpr float label_space = 2.0F;   // between labels that stand above each other
constexpr int label_rows = 5;         // above a place and below it
constexpr double behind_share = 0.02; // of the content's radius: how far behind the surface counts as hidden
constexpr double bar_px = 150.0;      // the scale bar is at most this long

Point in_window(const Pane& pane, const glm::dvec2& pixel) {
    return {pane.rect.x + static_cast<float>(pixel.x), pane.rect.y + static_cast<float>(pixel.y)};
}

ImVec2 vec(Point p) {
    return {p.x, p.y};
}

void draw_overlay_line(Point a, Point b, widgets::Colour colour, float width) {
    ImGui::GetWindowDrawList()->AddLine(vec(a), vec(b), colour, width);
}

float small_text_width(const widgets::Ui& ui, const std::string& text) {
    const ImFont* font = ui.look().fonts.small;
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0.0F, text.c_str()).x;
}

void draw_centred(widgets::Ui& ui, Point at, const std::string& text, widgets::Colour colour) {
    const ImFont* font = ui.look().fonts.small;
    const float wide = small_text_width(ui, text);
    ImGui::GetWindowDrawList()->AddText(
        font,
        font->FontSize,
        {std::round(at.x - 0.5F * wide), std::round(at.y - 0.5F * font->FontSize)},
        colour,
        text.c_str());
}

/// The middle of a label nearest to `at` with which nothing of it is cut off.
Point inside(const widgets::Ui& ui, const Rect& rect, Point at, const std::string& text) {
    const float half = 0.5F * small_text_width(ui, text) + ui.px(label_ground);
    at.x = std::max(std::min(at.x, rect.right() - half), rect.x + half);
    return at;
}

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// `at` inside the picture, at the left of what the words would cover of `fixed` if there is room.
Point aside(const widgets::Ui& ui,
            const Rect& picture,
            Point at,
            const std::string& text,
            std::span<const Rect> fixed) {
    at = inside(ui, picture, at, text);
    for (const Rect& other : fixed) {
        const Rect box = widgets::label_box(ui, at, text);
        const float left = other.x - ui.px(label_space) - box.w;
        if (overlap(box, other) && left >= picture.x) {
            at.x = left + 0.5F * box.w;
        }
    }
    return at;
}

/// The middle of words of `place`, above it or below it, as near as `taken`, `fixed` and the picture leave
/// room. None of a place out of the picture.
std::optional<Point> free_place(const widgets::Ui& ui,
                                const Rect& picture,
                                Point place,
                                const std::string& text,
                                std::span<const Rect> taken,
                                std::span<const Rect> fixed) {
    if (!picture.contains(place)) {
        return std::nullopt;
    }
    const float row = widgets::label_box(ui, place, text).h + ui.px(label_space);
    for (int n = 0; n < label_rows; ++n) {
        const float away = ui.px(label_above) + static_cast<float>(n) * row;
        for (const float y : {place.y - away, place.y + away}) {
            const Point at = aside(ui, picture, {place.x, y}, text, fixed);
            const auto covers = [box = widgets::label_box(ui, at, text)](const Rect& other) {
                return overlap(box, other);
            };
            if (picture.contains(at) && std::ranges::none_of(taken, covers) &&
                std::ranges::none_of(fixed, covers)) {
                return at;
            }
        }
    }
    return std::nullopt;
}

struct ScaleBar {
    double length = 0.0; ///< mm
    Point left;
    float width = 0.0F;
};

ScaleBar scale_bar_of(const widgets::Ui& ui, const Pane& pane, const glm::dvec3& point) {
    const double pixel = render::pixel_length(pane.view, point);
    const double length = round_length(bar_px * pane.view.content_scale * pixel);
    return {length,
            {pane.rect.x + ui.px(overlay_margin), pane.rect.bottom() - ui.px(overlay_margin)},
            static_cast<float>(length / pixel)};
}

constexpr float above_bar = 11.0F; // the middle of its words

/// A line of the caption, and where the next one begins.
float caption_step(const widgets::Ui& ui, std::string_view line, float room) {
    const ImFont* font = ui.look().fonts.small;
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, room, line.data(), line.data() + line.size()).y +
           0.3F * font->FontSize;
}

float caption_room(const widgets::Ui& ui, const Pane& pane) {
    return std::max(pane.rect.w - 2.0F * ui.px(overlay_margin), 1.0F);
}

constexpr float caption_top = 10.0F;

/// "20 mm", "0.5 mm", "2 m".
std::string scale_bar_text(double length) {
    if (length >= 1000.0) {
        return shortest(length / 1000.0) + " m";
    }
    return shortest(length) + " mm";
}

widgets::Colour text_colour(const Pane& pane) {
    return to_colour(pane.colors.neutral[7]);
}

std::string coordinates(const Vec3& p) {
    return fixed(p.x(), 3) + "   " + fixed(p.y(), 3) + "   " + fixed(p.z(), 3);
}

std::string drag_text(const PointDrag& drag) {
    const MovedControlPoint& point = drag.grabbed();
    const std::string name = "P(" + std::to_string(point.id.i) + "," + std::to_string(point.id.j) + ")   ";
    return name + coordinates(point.position + drag.moved()) + "   moved " + fixed(drag.moved().norm(), 3) +
           " mm";
}

std::string move_text(const Scene& scene, int move) {
    const toolpath::MoveDeviation& deviation = scene.shown->field.moves[static_cast<std::size_t>(move)];
    return "move " + std::to_string(move + 1) + "   error " + fixed(deviation.closest, 4) + " mm   axis " +
           fixed(to_degrees(deviation.axis), 2) + "\u00B0";
}

std::string arm_text(const ArmScene& scene, const ArmGrip& grip) {
    if (grip.is_tip()) {
        const Frame tool = arm::base_T_tool(scene.look->arm(), scene.joints);
        return coordinates(tool.translation()) + " mm";
    }
    if (grip.is_part()) {
        return "Path   " + (scene.part ? coordinates(scene.part->translation()) + " mm" : std::string());
    }
    const arm::ArmJoint& joint = scene.look->arm().joint(grip.joint);
    const bool turns = joint.kind == arm::JointKind::revolute;
    const double position = scene.joints[grip.joint];
    return "Joint " + joint.name + "   " + fixed(turns ? to_degrees(position) : position, 2) +
           (turns ? "\u00B0" : " mm");
}

} // namespace

widgets::Colour to_colour(const glm::vec3& color, double opacity) {
    const auto channel = [](float c) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(c, 0.0F, 1.0F) * 255.0F));
    };
    return widgets::rgb(channel(color.r) << 16U | channel(color.g) << 8U | channel(color.b), opacity);
}

render::Theme theme_of(const widgets::Ui& ui) {
    return ui.look().theme == widgets::Theme::dark ? render::Theme::dark : render::Theme::light;
}

std::vector<Label>
visible_labels(const SceneView& view, const Scene& scene, const SurfacePicker& picker, const Pane& pane) {
    std::vector<Label> labels = view.labels(pane.view, pane.colors);
    const Frame s_T_w = scene_from_workpiece(scene);
    const double tolerance = behind_share * radius(view.content());
    std::erase_if(labels, [&](const Label& label) {
        const auto seen = render::project(pane.view, label.position);
        if (!seen) {
            return true;
        }
        const render::Ray sight = render::ray(pane.view, seen->pixel);
        const auto hit = picker.hit(sight, s_T_w);
        const double away = glm::dot(label.position - sight.origin, sight.direction);
        return scene.layers.design.surface && hit && away > hit->distance + tolerance;
    });
    return labels;
}

std::vector<Rect>
draw_labels(widgets::Ui& ui, const Pane& pane, std::span<const Label> labels, std::span<const Rect> fixed) {
    std::vector<Rect> taken;
    for (const Label& label : labels) {
        const auto seen = render::project(pane.view, label.position);
        if (!seen) {
            continue;
        }
        const Point place = in_window(pane, seen->pixel);
        if (label.mark) {
            draw_centred(ui, place, label.text, to_colour(label.color));
        } else if (const auto at = free_place(ui, pane.rect, place, label.text, taken, fixed)) {
            widgets::label_at(ui, *at, label.text, to_colour(label.color));
            taken.push_back(widgets::label_box(ui, *at, label.text));
        }
    }
    return taken;
}

void draw_scale_bar(widgets::Ui& ui, const Pane& pane, const glm::dvec3& point) {
    const ScaleBar bar = scale_bar_of(ui, pane, point);
    const Point left = bar.left;
    const Point right = {left.x + bar.width, left.y};
    const float tick = ui.px(5.0F);
    const widgets::Colour colour = to_colour(render::ink(pane.colors));
    for (const auto& [a, b] : {std::pair{left, right},
                               std::pair{Point{left.x, left.y - tick}, left},
                               std::pair{Point{right.x, right.y - tick}, right}}) {
        draw_overlay_line(a, b, colour, ui.px(1.5F));
    }
    const Point middle{0.5F * (left.x + right.x), left.y - ui.px(above_bar)};
    draw_centred(ui, middle, scale_bar_text(bar.length), colour);
}

Rect scale_bar_place(const widgets::Ui& ui, const Pane& pane, const glm::dvec3& point) {
    const ScaleBar bar = scale_bar_of(ui, pane, point);
    const float height = ui.px(above_bar) + 0.5F * ui.look().fonts.small->FontSize;
    return {bar.left.x, bar.left.y - height, bar.width, height};
}

Rect caption_place(const widgets::Ui& ui,
                   const Pane& pane,
                   std::string_view name,
                   std::string_view left_out) {
    const ImFont* font = ui.look().fonts.small;
    const float room = caption_room(ui, pane);
    Rect place{pane.rect.x + ui.px(overlay_margin), pane.rect.y + ui.px(caption_top), 0.0F, 0.0F};
    for (const std::string_view line : {name, left_out}) {
        if (!line.empty()) {
            const char* const end = line.data() + line.size();
            place.w =
                std::max(place.w, font->CalcTextSizeA(font->FontSize, FLT_MAX, room, line.data(), end).x);
            place.h += caption_step(ui, line, room);
        }
    }
    return place;
}

void draw_caption(widgets::Ui& ui, const Pane& pane, std::string_view name, std::string_view left_out) {
    const ImFont* font = ui.look().fonts.small;
    float y = pane.rect.y + ui.px(caption_top);
    if (!left_out.empty()) {
        ui.record("left_out", {pane.rect.x, y, pane.rect.w, font->FontSize});
    }
    const float room = caption_room(ui, pane);
    for (const std::string_view line : {name, left_out}) {
        if (!line.empty()) {
            ImGui::GetWindowDrawList()->AddText(font,
                                                font->FontSize,
                                                {pane.rect.x + ui.px(overlay_margin), y},
                                                to_colour(render::faint_ink(pane.colors)),
                                                line.data(),
                                                line.data() + line.size(),
                                                room);
            y += caption_step(ui, line, room);
        }
    }
}

void draw_box(const Pane& pane, const MouseTool::Box& box) {
    const ImVec2 a = vec(in_window(pane, box.corner));
    const ImVec2 b = vec(in_window(pane, box.opposite));
    const ImVec2 low = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const ImVec2 high = {std::max(a.x, b.x), std::max(a.y, b.y)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, to_colour(pane.colors.accent, 0.15));
    list.AddRect(low, high, to_colour(pane.colors.accent, 0.9));
}

void draw_hint(widgets::Ui& ui,
               const Pane& pane,
               const Scene& scene,
               const MouseTool& mouse_tool,
               std::span<const Rect> fixed) {
    const auto at_mouse = [&](const std::string& text) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const Point at = aside(ui, pane.rect, {mouse.x, mouse.y - ui.px(label_above + 6.0F)}, text, fixed);
        ui.record("hint", widgets::label_box(ui, at, text));
        widgets::label_at(ui, at, text, text_colour(pane));
    };
    const auto& height = mouse_tool.under_mouse().stock_height;
    const std::string stock = height ? height_text(*height, scene.stock_tolerance) : std::string();
    if (scene.arm && mouse_tool.highlight().arm) {
        at_mouse(arm_text(*scene.arm, *mouse_tool.highlight().arm));
    } else if (mouse_tool.drag()) {
        const PointDrag& drag = *mouse_tool.drag();
        const Vec3 place = scene_from_workpiece(scene) * Vec3(drag.grabbed().position + drag.moved());
        const Label label = {render::to_glm(place), drag_text(drag), pane.colors.selected};
        draw_labels(ui, pane, std::span(&label, 1), fixed);
    } else if (mouse_tool.highlight().move && scene.shown) {
        at_mouse(move_text(scene, *mouse_tool.highlight().move) + (stock.empty() ? "" : ", " + stock));
    } else if (!stock.empty()) {
        at_mouse(stock);
    }
}

} // namespace millwright::viewport
