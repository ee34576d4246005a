// Round smooth points of a fixed size on the screen, with an optional ring, and a mark for the selected ones.
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

struct PointVertex {
    glm::vec3 position{0.0F};
    glm::vec4 color{1.0F}; ///< used by ColorFrom::vertex
    float value = 0.0F;    ///< used by ColorFrom::value
    float selected = 0.0F; ///< 1 selected, 0 not
};

class PointBuffer {
public:
    /// Draws nothing.
    PointBuffer() = default;
    explicit PointBuffer(std::span<const PointVertex> points);

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] GlId vertex_array() const { return layout_ ? layout_->id() : 0U; }

private:
    Buffer vertices_;
    std::optional<VertexArray> layout_;
    int count_ = 0;
};

struct PointStyle {
    Coloring coloring = {};
    glm::mat4 model{1.0F}; ///< buffer's coordinates to the scene's
    float size_px = 8.0F;  ///< diameter with the ring; this and the others times the view's content scale
    float ring_px = 0.0F;  ///< width of the ring
    glm::vec4 ring_color{0.0F, 0.0F, 0.0F, 1.0F};
    float selected_size_px = 11.0F;
    glm::vec4 selected_color{1.0F, 0.65F, 0.15F, 1.0F};
    Depth depth = Depth::tested;
};

class PointDrawer {
public:
    PointDrawer();
    void
    draw(const PointBuffer& buffer, const PointStyle& style, const View& view, const Texture& maps) const;

private:
    ShaderProgram program_;
};

} // namespace millwright::render
