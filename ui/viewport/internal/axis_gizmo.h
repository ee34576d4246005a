// The axes of the scene in the upper right corner of a picture: shows where one looks from, and turns the
// view to a side by a click on an end.
#pragma once

#include "ui/render/camera.h"
#include "ui/viewport/internal/overlay.h"

#include <optional>

namespace millwright::viewport {

/// The side whose end was clicked.
[[nodiscard]] std::optional<render::StandardView> axis_gizmo(widgets::Ui& ui, const Pane& pane);

} // namespace millwright::viewport
