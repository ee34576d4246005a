// Words and signs over the picture of a view: names of places, scale bar, caption, the selection's box.
#pragma once

#include "ui/render/view_colors.h"
#include "ui/viewport/mouse_tool.h"
#include "ui/viewport/scene_view.h"
#include "ui/widgets/ui.h"

#include <span>
#include <string_view>
#include <vector>

namespace millwright::viewport {

inline constexpr float overlay_margin = 14.0F; ///< from the picture's border, pixels at scale 1

/// One picture in the window.
struct Pane {
    widgets::Rect rect;
    render::View view;
    render::ViewColors colors;
};

[[nodiscard]] widgets::Colour to_colour(const glm::vec3& color, double opacity = 1.0);

/// The theme of the widgets as the 3D view's.
[[nodiscard]] render::Theme theme_of(const widgets::Ui& ui);

/// The labels of the scene whose places are not hidden by its surface.
[[nodiscard]] std::vector<Label>
visible_labels(const SceneView& view, const Scene& scene, const SurfacePicker& picker, const Pane& pane);

/// Words stand above their places, or below them, aside or further away where they would cover others or
/// `fixed`; those that find no room are left out. Returns the grounds of the words.
std::vector<widgets::Rect> draw_labels(widgets::Ui& ui,
                                       const Pane& pane,
                                       std::span<const Label> labels,
                                       std::span<const widgets::Rect> fixed = {});

/// A round length at `point` (scene), at the lower left.
void draw_scale_bar(widgets::Ui& ui, const Pane& pane, const glm::dvec3& point);
/// With its words.
[[nodiscard]] widgets::Rect scale_bar_place(const widgets::Ui& ui, const Pane& pane, const glm::dvec3& point);

/// The name of a picture among others, at the upper left, and below it what the picture leaves out.
void draw_caption(widgets::Ui& ui, const Pane& pane, std::string_view name, std::string_view left_out = {});
/// The ground of both.
[[nodiscard]] widgets::Rect
caption_place(const widgets::Ui& ui, const Pane& pane, std::string_view name, std::string_view left_out);

void draw_box(const Pane& pane, const MouseTool::Box& box);

/// The ring of the brush, and the outline with its corners, recorded as `corner(k)`.
void draw_surface_tool(widgets::Ui& ui,
                       const Pane& pane,
                       const Scene& scene,
                       const SurfacePicker& picker,
                       const SurfaceMouseTool& mouse_tool);

/// What is being dragged or pointed at, beside it; not over `fixed`.
void draw_hint(widgets::Ui& ui,
               const Pane& pane,
               const Scene& scene,
               const MouseTool& mouse_tool,
               std::span<const widgets::Rect> fixed);

} // namespace millwright::viewport
