// What a view says below its name: what it leaves out, and what it cannot draw.
#pragma once

#include "ui/render/view.h"
#include "ui/viewport/scene.h"

#include <string>

namespace millwright::viewport {

/// Why the layer of the produced surface is empty; "" where it is hidden or has a surface.
[[nodiscard]] std::string produced_note(const Scene& scene);

/// One line per note; "" where there is none.
[[nodiscard]] std::string view_notes(const Scene& scene, const render::View& view);

} // namespace millwright::viewport
