// Thin lines of millions of pieces in little memory: 8 bytes per point. What is drawn of them is chosen anew
// for each picture, by indices.
#pragma once

#include "ui/render/coloring.h"
#include "ui/render/gl_objects.h"
#include "ui/render/shader_program.h"
#include "ui/render/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace millwright::render {

inline constexpr std::size_t path_kinds = 4;
/// Among the indices of a path: the line ends here, another one begins.
inline constexpr std::uint16_t path_restart = 0xFFFF;

struct PathVertex {
    std::array<std::uint16_t, 3> place{}; ///< 0 to 65535 across the box of its buffer
    std::uint16_t kind = 0;               ///< of the piece that ends here, below path_kinds
};
static_assert(sizeof(PathVertex) == 8);

/// `point` among 65536 places of each side of the box; a box without extent has all at its corner.
[[nodiscard]] PathVertex
path_vertex(const float* point, std::uint16_t kind, const glm::vec3& min, const glm::vec3& max);

class PathBuffer {
public:
    /// Draws nothing.
    PathBuffer() = default;
    /// At most 65535 vertices in the box from `min` to `max`, which is in the coordinates of the scene.
    PathBuffer(std::span<const PathVertex> vertices, const glm::vec3& min, const glm::vec3& max);

    [[nodiscard]] const glm::mat4& scene_from_buffer() const { return scene_from_buffer_; }
    [[nodiscard]] const VertexArray* vertex_array() const { return layout_ ? &*layout_ : nullptr; }

private:
    Buffer vertices_;
    std::optional<VertexArray> layout_;
    glm::mat4 scene_from_buffer_{1.0F};
};

struct PathStyle {
    std::array<glm::vec4, path_kinds> color{};      ///< by kind; opacity 0: not drawn
    std::array<glm::vec4, path_kinds> done_color{}; ///< of the pieces that end at vertex `done` or before
    int done = -1;
    glm::mat4 model{1.0F}; ///< the buffer's scene to the view's
};

class PathDrawer {
public:
    PathDrawer();
    /// Lines through the vertices of `indices`, which may hold path_restart.
    void draw(const PathBuffer& buffer,
              std::span<const std::uint16_t> indices,
              const PathStyle& style,
              const View& view) const;

private:
    ShaderProgram program_;
};

} // namespace millwright::render
