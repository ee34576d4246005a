// A stroke font of our own: the printing characters of ASCII, drawn for this project on a grid of 4 by 9.
#pragma once

#include "core/geometry/vectors.h"

#include <optional>
#include <vector>

namespace millwright::plot {

/// The lines of one character. x: 0 to 1, the width of a capital; y: 0 the line that letters stand on, 1 the
/// height of capitals, down to -1/2 below the line.
using Glyph = std::vector<std::vector<Vec2>>;

/// Nothing for what is no printing character of ASCII; a blank has no lines.
[[nodiscard]] std::optional<Glyph> glyph(char character);

} // namespace millwright::plot
