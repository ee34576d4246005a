// Words and signs over the picture of a view: names of places, scale bar, legend, the selection's box.
#pragma once

#include "ui/render/view_colors.h"
#include "ui/viewport/hand.h"
#include "ui/viewport/scene_view.h"
#include "ui/widgets/ui.h"

#include <span>
#include <string_view>
#include <vector>

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

/// Words stand above their places, or below them or further away where they would cover others; those that
/// find no room are left out. Returns the grounds of the words.
std::vector<widgets::Rect> draw_labels(widgets::Ui& ui, const Pane& pane, std::span<const Label> labels);

/// A round length at `point` (scene), at the lower left.
void draw_scale_bar(widgets::Ui& ui, const Pane& pane, const glm::dvec3& point);

/// Where the legends of a scene stand in a picture, and what of it they leave free.
struct LegendPlaces {
    std::vector<widgets::Rect> each = {};
    bool lying = false;
    widgets::Rect free = {};
};

/// Below each other at the left above the scale bar, or beside each other where the picture is too low.
[[nodiscard]] LegendPlaces
upright_legends(const widgets::Ui& ui, const widgets::Rect& picture, const Scene& scene);

/// Lying beside each other in a strip at the bottom of `strip`, from `left` on.
[[nodiscard]] LegendPlaces
lying_legends(const widgets::Ui& ui, const widgets::Rect& picture, float left, const Scene& scene);

/// Upright in a wide picture; lying, beside the scale bar, in a narrow one.
[[nodiscard]] LegendPlaces
legends_of(const widgets::Ui& ui, const widgets::Rect& picture, const Scene& scene);

/// What the colours of errors, weight and others mean; nothing where there are none. `beside`: another scene
/// that is drawn in the same colours of the errors.
void draw_legends(widgets::Ui& ui,
                  const LegendPlaces& places,
                  const render::ViewColors& colors,
                  const Scene& scene,
                  const Scene* beside = nullptr);

/// As high as a strip of lying legends.
[[nodiscard]] float legend_strip_height(const widgets::Ui& ui);

/// The name of a picture among others, at the upper left, and below it what the picture leaves out.
void draw_caption(widgets::Ui& ui, const Pane& pane, std::string_view name, std::string_view left_out = {});

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
