#include "core/plan/part_bodies.h"

#include "core/geometry/mesh.h"
#include "core/geometry/trim.h"

#include <utility>

namespace millwright::plan {

std::vector<simulation::CollisionBody> face_bodies(const kinematics::MachineModel& machine,
                                                   const project::SurfaceInput& input,
                                                   const geometry::Surface& surface) {
    using simulation::BodyRole;
    constexpr int steps = 100;
    std::vector<simulation::CollisionBody> bodies;
    simulation::CollisionTriangles others;
    const auto parts = surface.parts();
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const bool machined = !input.has_patches() || static_cast<int>(n) == input.machined_patch;
        const geometry::Trim trim = machined ? input.machined_trim() : input.trim(static_cast<int>(n));
        const geometry::Mesh mesh = trim.everything()
                                        ? geometry::tessellate(*parts[n], steps, steps)
                                        : geometry::tessellate(*parts[n], trim, steps, steps).mesh;
        if (machined) {
            bodies.push_back(simulation::collision_body(
                machine, "part", BodyRole::cut_faces, {mesh.positions, mesh.triangles}, false));
            continue;
        }
        const int first = static_cast<int>(others.points.size());
        others.points.insert(others.points.end(), mesh.positions.begin(), mesh.positions.end());
        for (const auto& [a, b, c] : mesh.triangles) {
            others.triangles.push_back({a + first, b + first, c + first});
        }
    }
    if (!others.triangles.empty()) {
        bodies.push_back(simulation::collision_body(
            machine, "other faces of the part", BodyRole::part, std::move(others), false));
    }
    return bodies;
}

} // namespace millwright::plan
