// Which points of a long path a picture shows: at most so many, those whose absence would be seen most.
#pragma once

#include "core/gcode/preview_path.h"
#include "ui/render/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace millwright::viewport {

/// For each chunk the indices of the points to draw, with render::path_restart between two lines. Blocks that
/// lie outside of the picture are left out. The limit holds unless the coarsest level of all that is in sight
/// has more. Of stretches that are drawn as one straight line each, one is left out where another of the same
/// kind has its ends within the same squares of `same_px` pixels; 0: none is.
[[nodiscard]] std::vector<std::vector<std::uint16_t>>
visible_pieces(std::span<const std::shared_ptr<const gcode::PathChunk>> chunks,
               const render::View& view,
               std::size_t most_points,
               double same_px = 0.0);

} // namespace millwright::viewport
