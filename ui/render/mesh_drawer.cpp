#include "ui/render/mesh_drawer.h"

#include "core/base/error.h"
#include "ui/render/internal/draw_state.h"
#include "ui/render/internal/gl.h"

#include <algorithm>
#include <cstddef>

namespace millwright::render {

MeshBuffer::MeshBuffer(std::span<const MeshVertex> vertices, std::span<const std::uint32_t> triangles) {
    expects(triangles.size() % 3 == 0, "a triangle has three indices");
    expects(std::ranges::all_of(triangles, [&](std::uint32_t i) { return i < vertices.size(); }),
            "a triangle's index is one of its vertices");
    if (triangles.empty()) {
        return;
    }
    vertices_ = Buffer(std::as_bytes(vertices));
    indices_ = Buffer(std::as_bytes(triangles));
    index_count_ = static_cast<int>(triangles.size());
    constexpr std::ptrdiff_t stride = sizeof(MeshVertex);
    layout_.emplace();
    layout_->attach(vertices_, {0, 3, stride, offsetof(MeshVertex, position), false});
    layout_->attach(vertices_, {1, 3, stride, offsetof(MeshVertex, normal), false});
    layout_->attach(vertices_, {2, 4, stride, offsetof(MeshVertex, color), false});
    layout_->attach(vertices_, {3, 1, stride, offsetof(MeshVertex, value), false});
    layout_->attach_indices(indices_);
}

namespace {

/// Known to cover what is behind it; software renderers then save a quarter of the time.
bool opaque(const Coloring& coloring) {
    const float own = coloring.from == ColorFrom::style ? coloring.color.a : 1.0F;
    return coloring.from != ColorFrom::vertex && own * coloring.opacity >= 1.0F;
}

} // namespace

MeshDrawer::MeshDrawer() : program_(shader_source("mesh.vert"), shader_source("mesh.frag")) {}

void MeshDrawer::draw(const MeshBuffer& buffer,
                      const MeshStyle& style,
                      const View& view,
                      const Texture& maps) const {
    if (buffer.index_count() == 0) {
        return;
    }
    program_.use();
    set_view(program_, view, style.model);
    set_coloring(program_, style.coloring, maps);
    const glm::dmat4 light = unsheared(view);
    program_.set("light_from_buffer", glm::mat4(light * glm::dmat4(style.model)));
    program_.set("up", glm::vec3(light[2]));
    program_.set("lit", style.lit ? 1 : 0);
    program_.set("highlight", style.highlight);
    program_.set("has_back", style.back_color ? 1 : 0);
    program_.set("back_color", style.back_color.value_or(glm::vec3(0.0F)));
    set_depth(style.depth);
    if (opaque(style.coloring)) {
        glDisable(GL_BLEND);
        if (style.closed && style.depth == Depth::tested) {
            glEnable(GL_CULL_FACE);
        }
    }
    // One step back, so that lines between its own vertices lie on it.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0F, 1.0F);
    glBindVertexArray(buffer.vertex_array());
    glDrawElements(GL_TRIANGLES, buffer.index_count(), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

} // namespace millwright::render
