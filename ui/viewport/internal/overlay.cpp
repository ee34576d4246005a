#include "ui/viewport/internal/overlay.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/arm_forward.h"
#include "ui/render/convert.h"
#include "ui/render/ink.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/legend.h"

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
constexpr float overlay_margin = 14.0F;
constexpr float label_ground = 6.0F; // beyond a label's text
constexpr float label_above = 23.0F;
constexpr float label_space = 2.0F; // between labels that stand above each other
constexpr float legend_width = 92.0F;
constexpr float legend_height = 250.0F;
constexpr float least_legend_height = 110.0F;
constexpr float legend_top = 16.0F; // left free above it, for a caption
constexpr float above_scale_bar = 44.0F;
constexpr float narrow_picture = 760.0F; // an upright legend would take too much of a picture below this
constexpr float lying_height = 34.0F;
constexpr float lying_width = 250.0F;
constexpr float least_lying_width = 120.0F;
constexpr float beside_scale_bar = 168.0F;
constexpr int label_rows = 5;         // above a place and below it
constexpr double behind_share = 0.02; // of the content's radius: how far behind the surface counts as hidden
constexpr double bar_px = 150.0;      // the scale bar is at most this long

bool reaches(const project::SetUpStudy& study) {
    return std::ranges::any_of(study.map.costs, [](double cost) { return std::isfinite(cost); });
}

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

/// The middle of words of `place`, above it or below it, as near as `taken` and the picture leave room. None
/// of a place out of the picture.
std::optional<Point> free_place(const widgets::Ui& ui,
                                const Rect& picture,
                                Point place,
                                const std::string& text,
                                std::span<const Rect> taken) {
    if (!picture.contains(place)) {
        return std::nullopt;
    }
    const float row = widgets::label_box(ui, place, text).h + ui.px(label_space);
    for (int n = 0; n < label_rows; ++n) {
        const float away = ui.px(label_above) + static_cast<float>(n) * row;
        for (const float y : {place.y - away, place.y + away}) {
            const Point at = inside(ui, picture, {place.x, y}, text);
            const auto covers = [box = widgets::label_box(ui, at, text)](const Rect& other) {
                return overlap(box, other);
            };
            if (picture.contains(at) && std::ranges::none_of(taken, covers)) {
                return at;
            }
        }
    }
    return std::nullopt;
}

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
        const Frame tool = kinematics::base_T_tool(scene.look->arm(), scene.joints);
        return coordinates(tool.translation()) + " mm";
    }
    if (grip.is_part()) {
        return "Path   " + (scene.part ? coordinates(scene.part->translation()) + " mm" : std::string());
    }
    const kinematics::ArmJoint& joint = scene.look->arm().joint(grip.joint);
    const bool turns = joint.kind == kinematics::JointKind::revolute;
    const double position = scene.joints[grip.joint];
    return "Joint " + joint.name + "   " + fixed(turns ? to_degrees(position) : position, 2) +
           (turns ? "\u00B0" : " mm");
}

struct Legend {
    std::string_view id, title, unit, tip;
    render::ColorScale scale;
    std::optional<double> largest = {};
};

/// What of the picture has its colours from numbers.
std::vector<Legend> legends(const Scene& scene, const render::ViewColors& colors) {
    std::vector<Legend> found;
    const SurfaceColors surface = surface_colors(scene);
    if (scene.shown && (scene.layers.error_path || surface == SurfaceColors::error)) {
        found.push_back({"legend",
                         "Error",
                         "mm",
                         "The largest distance of the tool's true way from the surface, move by move.",
                         error_colors(scene, colors.over_limit),
                         scene.shown->closest.max});
    }
    if (surface == SurfaceColors::scallop) {
        found.push_back(
            {"scallop_legend",
             "Left",
             "mm",
             "The height of what the cutter leaves; the signal colour is higher, or not cut at all.",
             scallop_colors(scene, colors.over_limit)});
    }
    if (scene.layers.set_up_map && scene.set_up && scene.set_up->study && reaches(*scene.set_up->study)) {
        found.push_back({"set_up_legend",
                         "Set-up",
                         "mm",
                         "What the path costs with the part there: its mean error, or the machine's travel.",
                         set_up_colors(scene)});
    }
    if (surface == SurfaceColors::deviation) {
        found.push_back({"deviation_legend",
                         "Deviation",
                         "mm",
                         "Distance of the imported triangles from the patch; above zero on the side of its "
                         "normal.",
                         deviation_colors(scene)});
    }
    if (surface == SurfaceColors::weight) {
        found.push_back({"weight_legend",
                         "Weight",
                         "",
                         "The weight of the elliptic grid: the area of a cell goes like 1 / sqrt(weight).",
                         weight_colors(scene)});
    }
    return found;
}

int legend_count(const Scene& scene) {
    return static_cast<int>(legends(scene, render::view_colors(render::Theme::dark)).size());
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
        return scene.layers.surface && hit && away > hit->distance + tolerance;
    });
    return labels;
}

std::vector<Rect> draw_labels(widgets::Ui& ui, const Pane& pane, std::span<const Label> labels) {
    std::vector<Rect> taken;
    for (const Label& label : labels) {
        const auto seen = render::project(pane.view, label.position);
        if (!seen) {
            continue;
        }
        const Point place = in_window(pane, seen->pixel);
        if (label.mark) {
            draw_centred(ui, place, label.text, to_colour(label.color));
        } else if (const auto at = free_place(ui, pane.rect, place, label.text, taken)) {
            widgets::label_at(ui, *at, label.text, to_colour(label.color));
            taken.push_back(widgets::label_box(ui, *at, label.text));
        }
    }
    return taken;
}

void draw_scale_bar(widgets::Ui& ui, const Pane& pane, const glm::dvec3& point) {
    const double pixel = render::pixel_length(pane.view, point);
    const double length = round_length(bar_px * pane.view.content_scale * pixel);
    const auto width = static_cast<float>(length / pixel);
    const Point left = {pane.rect.x + ui.px(overlay_margin), pane.rect.bottom() - ui.px(overlay_margin)};
    const Point right = {left.x + width, left.y};
    const float tick = ui.px(5.0F);
    const widgets::Colour colour = to_colour(render::ink(pane.colors));
    for (const auto& [a, b] : {std::pair{left, right},
                               std::pair{Point{left.x, left.y - tick}, left},
                               std::pair{Point{right.x, right.y - tick}, right}}) {
        draw_overlay_line(a, b, colour, ui.px(1.5F));
    }
    draw_centred(ui, {0.5F * (left.x + right.x), left.y - ui.px(11.0F)}, scale_bar_text(length), colour);
}

LegendPlaces upright_legends(const widgets::Ui& ui, const Rect& picture, const Scene& scene) {
    LegendPlaces places{.free = picture};
    const auto count = static_cast<float>(legend_count(scene));
    const float space = ui.px(0.5F * overlay_margin);
    const float bottom = picture.bottom() - ui.px(above_scale_bar);
    const float room = bottom - picture.y - ui.px(overlay_margin + legend_top);
    const float stacked = std::min(ui.px(legend_height), (room - (count - 1.0F) * space) / count);
    const bool stands_above = stacked >= ui.px(least_legend_height);
    const float height = stands_above ? stacked : std::min(ui.px(legend_height), room);
    const float step_x = stands_above ? 0.0F : ui.px(legend_width) + space;
    const float step_y = stands_above ? height + space : 0.0F;
    Rect place{picture.x + ui.px(overlay_margin), bottom - height, ui.px(legend_width), height};
    for (int n = 0; n < legend_count(scene); ++n) {
        if (height < ui.px(least_legend_height) || place.right() > picture.right()) {
            break;
        }
        places.each.push_back(place);
        const float taken = place.right() + space - picture.x;
        places.free = {picture.x + taken, picture.y, picture.w - taken, picture.h};
        place.x += step_x;
        place.y -= step_y;
    }
    if (stands_above) {
        std::ranges::reverse(places.each); // the first one at the top
    }
    return places;
}

LegendPlaces lying_legends(const widgets::Ui& ui, const Rect& picture, float left, const Scene& scene) {
    LegendPlaces places{.lying = true, .free = picture};
    const int count = legend_count(scene);
    const float space = ui.px(0.5F * overlay_margin);
    const float room = picture.right() - space - left;
    const float each = std::min(ui.px(lying_width), room / static_cast<float>(std::max(count, 1)) - space);
    if (count == 0 || each < ui.px(least_lying_width)) {
        return places;
    }
    const float height = ui.px(lying_height);
    for (int n = 0; n < count; ++n) {
        const float x = left + static_cast<float>(n) * (each + space);
        places.each.push_back({x, picture.bottom() - height - ui.px(3.0F), each, height});
    }
    places.free.h -= legend_strip_height(ui);
    return places;
}

LegendPlaces legends_of(const widgets::Ui& ui, const Rect& picture, const Scene& scene) {
    const bool narrow = picture.w < ui.px(narrow_picture);
    const LegendPlaces lying =
        narrow ? lying_legends(ui, picture, picture.x + ui.px(beside_scale_bar), scene) : LegendPlaces{};
    return lying.each.empty() ? upright_legends(ui, picture, scene) : lying;
}

float legend_strip_height(const widgets::Ui& ui) {
    return ui.px(lying_height + 6.0F);
}

void draw_legends(widgets::Ui& ui,
                  const LegendPlaces& places,
                  const render::ViewColors& colors,
                  const Scene& scene,
                  const Scene* beside) {
    std::vector<Legend> all = legends(scene, colors);
    for (std::size_t n = 0; n < std::min(all.size(), places.each.size()); ++n) {
        Legend& legend = all[n];
        if (legend.largest && beside != nullptr && beside->shown) {
            legend.largest = std::max(*legend.largest, beside->shown->closest.max);
        }
        widgets::LegendView view = {
            .title = legend.title,
            .unit = legend.unit,
            .low = legend.scale.low,
            .high = legend.scale.high,
            .map = [map = legend.scale.map](double t) { return to_colour(render::sample(map, t)); },
            .largest = legend.largest,
            .tip = legend.tip,
            .lying = places.lying};
        if (legend.scale.limit) {
            view.over = to_colour(legend.scale.over_limit);
        }
        widgets::legend(ui, legend.id, places.each[n], view);
    }
}

void draw_caption(widgets::Ui& ui, const Pane& pane, std::string_view name, std::string_view left_out) {
    const ImFont* font = ui.look().fonts.small;
    float y = pane.rect.y + ui.px(10.0F);
    if (!left_out.empty()) {
        ui.record("left_out", {pane.rect.x, y, pane.rect.w, font->FontSize});
    }
    const float room = std::max(pane.rect.w - 2.0F * ui.px(overlay_margin), 1.0F);
    for (const std::string_view line : {name, left_out}) {
        if (!line.empty()) {
            const char* const end = line.data() + line.size();
            ImGui::GetWindowDrawList()->AddText(font,
                                                font->FontSize,
                                                {pane.rect.x + ui.px(overlay_margin), y},
                                                to_colour(render::faint_ink(pane.colors)),
                                                line.data(),
                                                end,
                                                room);
            y += font->CalcTextSizeA(font->FontSize, FLT_MAX, room, line.data(), end).y +
                 0.3F * font->FontSize;
        }
    }
}

void draw_box(const Pane& pane, const Hand::Box& box) {
    const ImVec2 a = vec(in_window(pane, box.corner));
    const ImVec2 b = vec(in_window(pane, box.opposite));
    const ImVec2 low = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const ImVec2 high = {std::max(a.x, b.x), std::max(a.y, b.y)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, to_colour(pane.colors.accent, 0.15));
    list.AddRect(low, high, to_colour(pane.colors.accent, 0.9));
}

void draw_hint(widgets::Ui& ui, const Pane& pane, const Scene& scene, const Hand& hand) {
    if (scene.arm && hand.highlight().arm) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        widgets::label_at(ui,
                          {mouse.x, mouse.y - ui.px(label_above + 6.0F)},
                          arm_text(*scene.arm, *hand.highlight().arm),
                          text_colour(pane));
    } else if (hand.drag()) {
        const PointDrag& drag = *hand.drag();
        const Vec3 place = scene_from_workpiece(scene) * Vec3(drag.grabbed().position + drag.moved());
        const Label label = {render::to_glm(place), drag_text(drag), pane.colors.selected};
        draw_labels(ui, pane, std::span(&label, 1));
    } else if (hand.highlight().move && scene.shown) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        widgets::label_at(ui,
                          {mouse.x, mouse.y - ui.px(label_above + 6.0F)},
                          move_text(scene, *hand.highlight().move),
                          text_colour(pane));
    }
}

} // namespace millwright::viewport
