// Colours for numbers: perceptually uniform maps that colour-blind people can read, over a stated range, with
// one signal colour above a limit. Colours are sRGB, 0 to 1.
//
// Source: viridis (van der Walt, Smith 2015, CC0) and cividis (Nunez, Anderton, Renslow 2018, CC0): each 17th
// entry of the published 256, interpolated in linear light.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string_view>

namespace millwright::render {

enum class ColorMap { viridis, cividis };

[[nodiscard]] std::string_view name(ColorMap map);

/// The colour at t; below 0 and above 1 the end colours. Throws Defect if t is not a number.
[[nodiscard]] glm::vec3 sample(ColorMap map, double t);

/// Relative luminance (CIE Y, 0 to 1) of an sRGB colour.
[[nodiscard]] double luminance(const glm::vec3& color);

/// Contrast of two colours after WCAG 2: 1 to 21.
[[nodiscard]] double contrast(const glm::vec3& a, const glm::vec3& b);

/// What a value looks like. `low` and `high` are the ends of the map, in the value's unit.
struct ColorScale {
    ColorMap map = ColorMap::viridis;
    double low = 0.0;
    double high = 1.0;
    std::optional<double> limit = std::nullopt; ///< above it: `over_limit`
    glm::vec3 over_limit{0.93F, 0.26F, 0.21F};
};

/// Exactly what the drawers show for `value`, before light. With low == high everything has the colour at 0.
[[nodiscard]] glm::vec3 color_of(const ColorScale& scale, double value);

} // namespace millwright::render
