// What the drawers of meshes, lines and points have in common: colours, blending, depth, and the two passes
// of smooth shapes.
#pragma once

#include "ui/render/coloring.h"
#include "ui/render/gl_objects.h"
#include "ui/render/shader_program.h"
#include "ui/render/view.h"

#include <glm/mat4x4.hpp>

#include <functional>

namespace millwright::render {

/// The colour maps as rows of one texture, in the order of ColorMap.
[[nodiscard]] Texture color_map_texture();

void set_coloring(const ShaderProgram& program, const Coloring& coloring, const Texture& maps);

/// Sets `eye_from_buffer`, `clip_from_eye` and `picture_px`.
void set_view(const ShaderProgram& program, const View& view, const glm::mat4& model);

/// Blending on, and depth as asked. `writes` false keeps the depth as it is in any case.
void set_depth(Depth depth, bool writes = true);

/// Runs `draw` once, or for shapes that hide others twice: the solid inside, then the soft edge.
void draw_smooth(const ShaderProgram& program, Depth depth, const std::function<void()>& draw);

} // namespace millwright::render
