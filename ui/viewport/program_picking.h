// Which piece of a long path lies under a pixel.
#pragma once

#include "core/gcode/preview_path.h"
#include "ui/render/view.h"

#include <cstddef>
#include <limits>
#include <optional>

namespace millwright::viewport {

inline constexpr std::size_t all_points = std::numeric_limits<std::size_t>::max();

/// The place of the path nearest to `pixel` on the screen and not further than `within_px`; of several that
/// lie as near the one closest to the eye. Nothing, too, if more than `most_points` would have to be looked
/// at.
[[nodiscard]] std::optional<gcode::PathPlace> pick_path(const gcode::PreviewPath& path,
                                                        const render::View& view,
                                                        const glm::dvec2& pixel,
                                                        double within_px,
                                                        std::size_t most_points = all_points);

} // namespace millwright::viewport
