// Smooth lines of any width, with round ends and joints. They lie over surfaces of the same depth.
#pragma once

#include "ui/render/coloring.h"
#include "ui/render/gl_objects.h"
#include "ui/render/shader_program.h"
#include "ui/render/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <span>

namespace millwright::render {

struct LineVertex {
    glm::vec3 position{0.0F};
    glm::vec4 color{1.0F}; ///< used by ColorFrom::vertex; blends along the line
    float value = 0.0F;    ///< used by ColorFrom::value; blends along the line
};

enum class LineTopology {
    segments, ///< each two vertices one line
    strip,    ///< one line through all vertices
};

class LineBuffer {
public:
    /// Draws nothing.
    LineBuffer() = default;
    /// Throws Defect for an odd number of vertices of segments.
    LineBuffer(std::span<const LineVertex> vertices, LineTopology topology);

    [[nodiscard]] int segment_count() const { return segment_count_; }
    [[nodiscard]] LineTopology topology() const { return topology_; }
    /// The vertex array, its first instance being segment `first`. Only if there are segments.
    [[nodiscard]] GlId vertex_array_from(int first) const;

private:
    Buffer vertices_;
    std::optional<VertexArray> layout_;
    LineTopology topology_ = LineTopology::segments;
    int segment_count_ = 0;
};

/// `on_px` drawn, `off_px` left out; starts anew at each segment. All zero: a whole line.
struct Dash {
    float on_px = 0.0F;
    float off_px = 0.0F;
};

struct LineStyle {
    Coloring coloring = {};
    glm::mat4 model{1.0F}; ///< buffer's coordinates to the scene's
    float width_px = 1.5F; ///< times the view's content scale
    Dash dash = {};
    Depth depth = Depth::tested;
    int first = 0;  ///< segment to start with
    int count = -1; ///< segments to draw, held to what there is; -1 for all
};

class LineDrawer {
public:
    LineDrawer();
    void draw(const LineBuffer& buffer, const LineStyle& style, const View& view, const Texture& maps) const;

private:
    ShaderProgram program_;
};

} // namespace millwright::render
