// What the colours of a picture mean: which legends it has, where they stand, and what of it they leave free.
#pragma once

#include "ui/render/view_colors.h"
#include "ui/viewport/scene.h"
#include "ui/widgets/ui.h"

#include <vector>

namespace millwright::viewport {

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

} // namespace millwright::viewport
