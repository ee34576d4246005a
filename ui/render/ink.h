// The colours of what is written straight on the background of a view, which a person can choose.
#pragma once

#include "ui/render/view_colors.h"

namespace millwright::render {

/// Of text and scales: the end of the neutral ramp that is read better on the background.
[[nodiscard]] glm::vec3 ink(const ViewColors& colors);
/// Of captions, next to that end.
[[nodiscard]] glm::vec3 faint_ink(const ViewColors& colors);

} // namespace millwright::render
