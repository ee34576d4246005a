// The surface that a simulation is compared with: where it is looked at, and triangles to show it by.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"
#include "core/plan/evaluation.h"
#include "core/simulation/comparison.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::plan {

struct PartSurface {
    std::string text;                          ///< for people
    std::vector<simulation::PartPoint> points; ///< where it is looked at
    std::vector<Vec3> corners;                 ///< of the triangles
    std::vector<int> point_of_corner;          ///< whose colour a corner has
    std::vector<std::array<int, 3>> triangles;
    bool closed = false; ///< a body: it is drawn from outside alone
};

/// The machined face with its outlines, normals on the side of the tool.
[[nodiscard]] PartSurface part_surface(const CuttingSetup& cutting_setup);

/// The triangles of an STL, OBJ or PLY file in mm, large ones divided. Throws Error, Cancelled.
[[nodiscard]] PartSurface part_surface(const std::filesystem::path& file, const Progress& progress);
/// The same of triangles at hand; `name` is for people. Throws Cancelled.
[[nodiscard]] PartSurface
part_surface(const exchange::TriangleMesh& mesh, const std::string& name, const Progress& progress);

/// Bytes that the surface of so many triangles takes.
[[nodiscard]] std::size_t part_surface_memory(std::size_t triangles);

/// Red: gouged beyond `tolerance` mm; green: within; blue: material left beyond it. One per corner.
[[nodiscard]] std::vector<std::array<std::uint8_t, 3>> deviation_colors(
    const PartSurface& part, const std::vector<simulation::Deviation>& deviations, double tolerance);

} // namespace millwright::plan
