// Solids of glb files on the graphics processor.
#pragma once

#include "core/geometry/solid.h"
#include "ui/render/mesh_drawer.h"

#include <glm/vec3.hpp>

#include <vector>

namespace millwright::viewport {

struct ColoredMesh {
    render::MeshBuffer mesh;
    glm::vec3 color{};
    bool closed = false; ///< geometry::is_closed
};

/// Each of the body's meshes, in their order.
[[nodiscard]] std::vector<ColoredMesh> buffers_of(const geometry::SolidBody& body);

} // namespace millwright::viewport
