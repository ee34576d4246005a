// What is left of the stock before a block, as meshes that can collide: cut again along the program, as far
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
    /// `surface`: as it is, but for sharp edges, which are broken by up to half the distance of the lines
    /// that it is made of, and for what is thinner than that. `blocks`: all that any line has, and more by
    /// less than a cube of a few cells. Uncut, both are the exact surface.
    enum class Shape { surface, blocks };

    /// The stock uncut. `input` must outlive it. Throws as simulate().
    RemainingStock(const SimulationInput& input, const Progress& progress);

    /// Cuts the blocks before `block`; blocks ascend. The meshes stay as they were. Throws as simulate().
    void advance_to(int block, const Progress& progress) { simulator_.advance_to(block, progress); }

    /// In m with all axes at their physical zero; null: nothing is left. What has been cut since it was made
    /// is still there.
    [[nodiscard]] const std::shared_ptr<const CollisionMesh>& mesh(Shape shape) const {
        return (shape == Shape::surface ? surface_ : blocks_).mesh;
    }
    /// Whether the mesh shows what is left around a place in workpiece coordinates.
    [[nodiscard]] bool is_current_near(const Vec3& place, Shape shape) const;
    /// Makes the mesh anew. Throws Cancelled.
    void renew(Shape shape, const Progress& progress);

private:
    using Versions = std::array<std::vector<std::uint32_t>, 3>;
    struct Made {
        std::shared_ptr<const CollisionMesh> mesh;
        Versions versions; // of the tiles when it was made
        int stride = 1;    // cells that it takes together
    };
    [[nodiscard]] Versions versions() const;

    Vec3 origin_; // of the workpiece in m
    Simulator simulator_;
    Made surface_, blocks_;
};

} // namespace millwright::simulation
