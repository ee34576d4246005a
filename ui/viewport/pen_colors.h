// The colours of a plot's pens: those of the KMITL thesis of 2006 (forming software for wood and plastic),
// where white and red are one.
#pragma once

#include "ui/render/view_colors.h"

#include <glm/vec3.hpp>

#include <string_view>

namespace millwright::viewport {

/// Beyond the sixth they begin anew; any number of a pen has one.
[[nodiscard]] glm::vec3 pen_color(int pen, render::Theme theme);
[[nodiscard]] std::string_view pen_name(int pen);

} // namespace millwright::viewport
