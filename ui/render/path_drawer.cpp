#include "ui/render/path_drawer.h"

#include "core/base/error.h"
#include "ui/render/internal/draw_state.h"
#include "ui/render/internal/gl.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace millwright::render {

namespace {

constexpr float last_place = 65535.0F;

void set_colors(const ShaderProgram& program,
                const char* name,
                const std::array<glm::vec4, path_kinds>& colors) {
    for (std::size_t k = 0; k < path_kinds; ++k) {
        program.set((std::string(name) + "[" + std::to_string(k) + "]").c_str(), colors[k]);
    }
}

} // namespace

PathVertex path_vertex(const float* point, std::uint16_t kind, const glm::vec3& min, const glm::vec3& max) {
    PathVertex vertex;
    vertex.kind = kind;
    for (int k = 0; k < 3; ++k) {
        const float extent = max[k] - min[k];
        const float share = extent > 0.0F ? std::clamp((point[k] - min[k]) / extent, 0.0F, 1.0F) : 0.0F;
        vertex.place[static_cast<std::size_t>(k)] =
            static_cast<std::uint16_t>(std::lround(share * last_place));
    }
    return vertex;
}

PathBuffer::PathBuffer(std::span<const PathVertex> vertices, const glm::vec3& min, const glm::vec3& max)
    : scene_from_buffer_(glm::scale(glm::translate(glm::mat4(1.0F), min), max - min)) {
    expects(vertices.size() < path_restart, "the indices of a path have 16 bits");
    if (vertices.empty()) {
        return;
    }
    vertices_ = Buffer(std::as_bytes(vertices));
    constexpr std::ptrdiff_t stride = sizeof(PathVertex);
    layout_.emplace();
    using Values = VertexArray::Values;
    layout_->attach(vertices_, {0, 3, stride, offsetof(PathVertex, place), false, Values::unit_16_bit});
    layout_->attach(vertices_, {1, 1, stride, offsetof(PathVertex, kind), false, Values::whole_16_bit});
}

PathDrawer::PathDrawer() : program_(shader_source("path.vert"), shader_source("path.frag")) {}

void PathDrawer::draw(const PathBuffer& buffer,
                      std::span<const std::uint16_t> indices,
                      const PathStyle& style,
                      const View& view) const {
    if (buffer.vertex_array() == nullptr || indices.empty()) {
        return;
    }
    const Buffer chosen(std::as_bytes(indices));
    program_.use();
    set_view(program_, view, style.model * buffer.scene_from_buffer());
    set_colors(program_, "kind_color", style.color);
    set_colors(program_, "done_color", style.done_color);
    program_.set("done", style.done);
    set_depth(Depth::tested);
    glEnable(GL_PRIMITIVE_RESTART);
    glPrimitiveRestartIndex(path_restart);
    buffer.vertex_array()->attach_indices(chosen);
    glBindVertexArray(buffer.vertex_array()->id());
    glDrawElements(GL_LINE_STRIP, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_SHORT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_PRIMITIVE_RESTART);
}

} // namespace millwright::render
