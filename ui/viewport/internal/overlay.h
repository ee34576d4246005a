// Words and signs over the picture of a view: names of places, scale bar, legend, the selection's box.
#pragma once

#include "ui/render/view_colors.h"
#include "ui/viewport/hand.h"
#include "ui/viewport/scene_view.h"
#include "ui/widgets/ui.h"

#include <span>
#include <string_view>

namespace millwright::viewport {

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

void draw_labels(widgets::Ui& ui, const Pane& pane, std::span<const Label> labels);

/// A round length at `point` (scene), at the lower left.
void draw_scale_bar(widgets::Ui& ui, const Pane& pane, const glm::dvec3& point);

/// What the colours of errors and weight mean, side by side at the left above the scale bar; nothing where
/// neither is shown.
void draw_legends(widgets::Ui& ui, const Pane& pane, const Scene& scene);

/// The name of a picture among four, at the upper left.
void draw_caption(widgets::Ui& ui, const Pane& pane, std::string_view text);

void draw_box(const Pane& pane, const Hand::Box& box);

/// The ring of the brush, and the outline with its corners, recorded as `corner(k)`.
void draw_surface_tool(widgets::Ui& ui,
                       const Pane& pane,
                       const Scene& scene,
                       const SurfacePicker& picker,
                       const SurfaceHand& hand);

/// What is being dragged or pointed at, beside it.
void draw_hint(widgets::Ui& ui, const Pane& pane, const Scene& scene, const Hand& hand);

} // namespace millwright::viewport
