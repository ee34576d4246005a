// Meshes as FCL sees them: trees of oriented boxes and swept spheres (OBBRSS). Lengths mm.
#pragma once

#include "core/simulation/collision_mesh.h"

#include <memory>
#include <optional>

namespace millwright::simulation {

class FclMesh {
public:
    explicit FclMesh(const CollisionTriangles& surface);
    ~FclMesh();
    FclMesh(const FclMesh&) = delete;
    FclMesh& operator=(const FclMesh&) = delete;

    /// As CollisionMesh::nearest().
    [[nodiscard]] std::optional<NearPlace>
    nearest(const FclMesh& other, const Frame& this_T_other, double enough) const;

private:
    struct Model;
    std::unique_ptr<const Model> model_;
};

} // namespace millwright::simulation
