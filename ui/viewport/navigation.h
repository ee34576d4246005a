// How mouse and keys move a camera.
#pragma once

#include "ui/render/camera.h"
#include "ui/widgets/canvas.h"

namespace millwright::viewport {

/// Orbit, pan and zoom as the front door (viewport.h) says; the same camera for anything else.
[[nodiscard]] render::Camera
navigated(const render::Camera& camera, const widgets::Pointer& pointer, const render::PixelSize& size);

/// The pointer is for the camera, not for what is in the scene.
[[nodiscard]] bool navigates(const widgets::Pointer& pointer);

} // namespace millwright::viewport
