// What a program that finishes a mesh leaves of it, by the simulation of material removal, which knows
// nothing of how the program was made; and where the cutter fits at all. docs/reference/meshes.md. Lengths
// mm.
#pragma once

#include "core/base/progress.h"
#include "core/mesh_finish/drop_tree.h"
#include "core/plan/part_surface.h"
#include "core/simulation/simulation.h"

#include <optional>
#include <vector>

namespace millwright::plan {

/// The farthest place of one kind.
struct FinishExtreme {
    double distance = 0.0; ///< above 0
    Vec3 place = Vec3::Zero();
};

struct FinishCheck {
    double area = 0.0;                  ///< of all points that were looked at, mm^2
    double fits = 0.0;                  ///< share of it where the cutter can touch without biting elsewhere
    double within = 0.0;                ///< share of that where no more than the tolerance is left
    std::optional<FinishExtreme> left;  ///< most that is left where it fits
    std::optional<FinishExtreme> gouge; ///< deepest cut below the mesh, anywhere
    std::vector<simulation::Deviation> deviations; ///< one per point of the surface
    std::vector<bool> fitting;
    double resolution = 0.0; ///< of the field
    /// Rapid moves through the allowance where nothing had cut it; none without one.
    std::vector<simulation::Finding> rapids;
};

struct FinishCheckInput {
    const mesh_finish::DropTree& tree;
    Mat3 frame = Mat3::Identity(); ///< from the part to the tree's coordinates
    const PartSurface& part;       ///< of the same mesh
    const program::Program& program;
    const kinematics::MachineModel& machine;
    toolpath::Profile cutter;
    double overrun = 0.0;              ///< of the passes beyond the mesh's box
    std::optional<double> allowance{}; ///< thickness of the material around the mesh; nullopt: not known
    double tolerance = 0.02;
    std::size_t most_bytes = 1UL << 30; ///< of the simulation's field
};

/// Whether the cutter can touch the mesh at a point of that normal, with mesh below it and its axis within
/// the passes, and bite nowhere deeper than `bite`; on a level place with any part of a flat end that is
/// tried: its middle, or its rim at one of 16 places.
[[nodiscard]] bool cutter_fits(const FinishCheckInput& input, const simulation::PartPoint& at, double bite);

/// Cut from a box around the mesh and the allowance that is a little higher. Of rapid moves in that box those
/// count that come nearer to the mesh than the allowance. Throws Error as simulate(); Cancelled.
[[nodiscard]] FinishCheck check_finish(const FinishCheckInput& input, const Progress& progress);

/// Bytes for the surface of so many triangles and what is found on it, without the simulation's field.
[[nodiscard]] std::size_t finish_check_memory(std::size_t triangles);

} // namespace millwright::plan
