#include "ui/render/convert.h"
#include "ui/viewport/internal/overlay.h"

#include <glm/geometric.hpp>
#include <imgui.h>

#include <optional>
#include <utility>
#include <vector>

namespace millwright::viewport {

namespace {

// Pixels at scale 1.
constexpr float line_width = 2.0F;
constexpr float corner_radius = 5.0F;
constexpr float corner_reach = 14.0F; // of a recorded corner

std::optional<ImVec2> seen_at(const Pane& pane, const Frame& s_T_w, const Vec3& place) {
    const auto seen = render::project(pane.view, render::to_glm(Vec3(s_T_w * place)));
    if (!seen) {
        return std::nullopt;
    }
    return ImVec2{pane.rect.x + static_cast<float>(seen->pixel.x),
                  pane.rect.y + static_cast<float>(seen->pixel.y)};
}

/// The surface lies before the place.
bool is_hidden(const Pane& pane, const SurfacePicker& picker, const Frame& s_T_w, const Vec3& place) {
    constexpr double behind = 0.01; // of the way from the eye: more than a triangle's sag
    const glm::dvec3 point = render::to_glm(Vec3(s_T_w * place));
    const auto seen = render::project(pane.view, point);
    if (!seen) {
        return true;
    }
    const render::Ray sight = render::ray(pane.view, seen->pixel);
    const auto hit = picker.hit(sight, s_T_w);
    return hit && glm::dot(point - sight.origin, sight.direction) > (1.0 + behind) * hit->distance;
}

void draw_pixel_line(widgets::Ui& ui, const std::vector<ImVec2>& pixels) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto count = static_cast<int>(pixels.size());
    list.AddPolyline(pixels.data(), count, to_colour(glm::vec3(0.0F), 0.55), 0, ui.px(2.0F * line_width));
    list.AddPolyline(pixels.data(), count, to_colour(glm::vec3(1.0F)), 0, ui.px(line_width));
}

/// With a dark edge, so that it is seen on any colour. What the surface hides is left out.
void draw_places(widgets::Ui& ui,
                 const Pane& pane,
                 const SurfacePicker& picker,
                 const Frame& s_T_w,
                 const std::vector<Vec3>& places) {
    constexpr std::size_t most_looks = 200; // each of which meets every triangle of the surface
    const std::size_t stride = 1 + places.size() / most_looks;
    std::vector<ImVec2> pixels;
    bool hidden = false;
    for (std::size_t n = 0; n < places.size(); ++n) {
        hidden = n % stride == 0 ? is_hidden(pane, picker, s_T_w, places[n]) : hidden;
        const auto pixel = hidden ? std::nullopt : seen_at(pane, s_T_w, places[n]);
        if (pixel) {
            pixels.push_back(*pixel);
        } else {
            draw_pixel_line(ui, std::exchange(pixels, {}));
        }
    }
    draw_pixel_line(ui, pixels);
}

void draw_corners(widgets::Ui& ui, const Pane& pane, const Scene& scene, const SurfaceMouseTool& mouse_tool) {
    const SurfaceTool& tool = scene.surface_tool;
    const geometry::ParametricSurface& patch = worked_surface(scene);
    const Frame s_T_w = scene_from_workpiece(scene);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t k = 0; k < tool.outline.size(); ++k) {
        const Vec2& uv = tool.outline[k];
        const auto pixel = seen_at(pane, s_T_w, patch.position(uv.x(), uv.y()));
        if (!pixel) {
            continue;
        }
        const bool marked = mouse_tool.corner() == static_cast<int>(k);
        list.AddCircleFilled(
            *pixel, ui.px(corner_radius), to_colour(marked ? pane.colors.selected : glm::vec3(1.0F)));
        list.AddCircle(*pixel, ui.px(corner_radius), to_colour(glm::vec3(0.0F), 0.8));
        const float reach = ui.px(corner_reach);
        ui.record("corner(" + std::to_string(k) + ")",
                  {pixel->x - 0.5F * reach, pixel->y - 0.5F * reach, reach, reach});
    }
}

} // namespace

void draw_surface_tool(widgets::Ui& ui,
                       const Pane& pane,
                       const Scene& scene,
                       const SurfacePicker& picker,
                       const SurfaceMouseTool& mouse_tool) {
    const SurfaceTool& tool = scene.surface_tool;
    if (!scene.surface || (tool.kind == SurfaceToolKind::none && tool.outline.empty())) {
        return;
    }
    const geometry::ParametricSurface& patch = worked_surface(scene);
    const Frame s_T_w = scene_from_workpiece(scene);
    draw_places(ui, pane, picker, s_T_w, outline_on(patch, tool.outline, tool.closed));
    if (tool.kind == SurfaceToolKind::outline) {
        draw_corners(ui, pane, scene, mouse_tool);
    }
    if (tool.kind == SurfaceToolKind::brush && mouse_tool.at()) {
        draw_places(ui, pane, picker, s_T_w, ring_on(patch, *mouse_tool.at(), tool.radius_mm));
    }
}

} // namespace millwright::viewport
