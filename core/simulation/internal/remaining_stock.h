// What is left of the stock before a block, as a mesh that can collide: cut again along the program, as far
// as it is asked for. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/collision_mesh.h"
#include "core/simulation/simulator.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace millwright::simulation {

class RemainingStock {
public:
    /// The stock uncut, with its exact surface. `input` must outlive it. Throws as simulate().
    RemainingStock(const SimulationInput& input, const Progress& progress);

    /// Cuts the blocks before `block`; blocks ascend. The mesh stays as it was. Throws as simulate().
    void advance_to(int block, const Progress& progress) { simulator_.advance_to(block, progress); }

    /// In m with all axes at their physical zero; null: nothing is left. More than there is, never less, but
    /// for sharp edges, which are broken by up to half a cell.
    [[nodiscard]] const std::shared_ptr<const CollisionMesh>& mesh() const { return mesh_; }
    /// Whether the mesh shows what is left around a place in workpiece coordinates.
    [[nodiscard]] bool is_current_near(const Vec3& place) const;
    /// Makes the mesh anew. Throws Cancelled.
    void renew(const Progress& progress);

private:
    using Versions = std::array<std::vector<std::uint32_t>, 3>;
    [[nodiscard]] Versions versions() const;

    Vec3 origin_; // of the workpiece in m
    Simulator simulator_;
    std::shared_ptr<const CollisionMesh> mesh_;
    int stride_ = 1;    // cells between the corners of the mesh
    Versions versions_; // of the tiles when the mesh was made
};

} // namespace millwright::simulation
