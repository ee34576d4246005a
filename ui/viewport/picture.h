// A view as a picture of its own, for files and reports: legend, title and the figures that matter beside it.
// Needs no display.
#pragma once

#include "core/plan/plan.h"
#include "ui/render/camera.h"
#include "ui/render/picture.h"
#include "ui/render/view_colors.h"
#include "ui/viewport/scene.h"

namespace millwright::viewport {

/// Of the workpiece's machine; null: it has none.
using MachineSolids = std::shared_ptr<const std::vector<geometry::SolidBody>>;

/// Puts what every view has of a plan into `scene`: the surface with its outlines, workpiece, poles, weight.
void show_plan(Scene& scene, const plan::Plan& plan);

/// All of `plan` as one view shows it at first, on the grid that the project chose.
[[nodiscard]] Scene scene_of(const project::Project& project, const plan::Plan& plan, ViewKind kind);

/// How a view is drawn, beside its contents.
struct PictureLook {
    render::StandardView side = render::StandardView::iso;
    render::LayerColors colors = {};
};

/// The same bytes each time. Makes a context of its own, which is current while it draws: a caller that has
/// one makes it current again. Not within a frame of ImGui. `machine_solids` as in a Scene. Throws Error if
/// there is no EGL or no OpenGL 3.3, or where the path has no produced surface to show; Defect if the size
/// has no area.
[[nodiscard]] render::Picture render_view(const project::Project& project,
                                          const plan::Plan& plan,
                                          ViewKind kind,
                                          const render::PixelSize& size,
                                          render::Theme theme,
                                          const MachineSolids& machine_solids = nullptr,
                                          const PictureLook& look = {});

} // namespace millwright::viewport
