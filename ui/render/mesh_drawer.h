// Triangles with light: a lamp over the left shoulder, a weaker one from the right, the sky, a soft
// highlight. Both sides are lit.
#pragma once

#include "ui/render/coloring.h"
#include "ui/render/gl_objects.h"
#include "ui/render/shader_program.h"
#include "ui/render/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace millwright::render {

struct MeshVertex {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F}; ///< need not have unit length
    glm::vec4 color{1.0F};              ///< used by ColorFrom::vertex
    float value = 0.0F;                 ///< used by ColorFrom::value
};

class MeshBuffer {
public:
    /// Draws nothing.
    MeshBuffer() = default;
    /// Three indices a triangle, counterclockwise seen from the side the normals point to. Throws Defect for
    /// an index outside or a count that is no multiple of 3.
    MeshBuffer(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> triangles);

    [[nodiscard]] int index_count() const { return index_count_; }
    [[nodiscard]] GlId vertex_array() const { return layout_ ? layout_->id() : 0U; }

private:
    Buffer vertices_;
    Buffer indices_;
    std::optional<VertexArray> layout_;
    int index_count_ = 0;
};

struct MeshStyle {
    Coloring coloring = {};
    glm::mat4 model{1.0F}; ///< buffer's coordinates to the scene's; turns, moves and scales evenly
    std::optional<glm::vec3> back_color = std::nullopt; ///< of the side the normals point away from
    float highlight = 0.12F;                            ///< strength of the soft highlight, 0 for none
    bool lit = true;                                    ///< false shows the plain colours
    Depth depth = Depth::tested;
    bool closed = false; ///< a body without holes: opaque, its triangles that look away are not drawn
};

class MeshDrawer {
public:
    MeshDrawer();
    void draw(const MeshBuffer& buffer, const MeshStyle& style, const View& view, const Texture& maps) const;

private:
    ShaderProgram program_;
};

} // namespace millwright::render
