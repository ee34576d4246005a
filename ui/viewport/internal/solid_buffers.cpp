#include "ui/viewport/internal/solid_buffers.h"

#include "core/geometry/solid.h"
#include "ui/render/convert.h"

namespace millwright::viewport {

namespace {

render::MeshBuffer solid_buffer(const geometry::SolidMesh& mesh) {
    std::vector<render::MeshVertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        vertices.push_back(
            {.position = render::to_float(mesh.positions[n]), .normal = render::to_float(mesh.normals[n])});
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        for (const int corner : triangle) {
            indices.push_back(static_cast<std::uint32_t>(corner));
        }
    }
    return {vertices, indices};
}

} // namespace

std::vector<ColoredMesh> buffers_of(const geometry::SolidBody& body) {
    std::vector<ColoredMesh> meshes;
    for (const geometry::SolidMesh& mesh : body.meshes) {
        meshes.push_back({solid_buffer(mesh), render::to_float(mesh.color), geometry::is_closed(mesh)});
    }
    return meshes;
}

} // namespace millwright::viewport
