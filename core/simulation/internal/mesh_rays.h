// Closed meshes seen along lines. Lengths mm.
#pragma once

#include "core/simulation/stock.h"

#include <string>
#include <vector>

namespace millwright::simulation {

/// As fault_of(Stock).
[[nodiscard]] std::string fault_of_mesh(const MeshStock& mesh);
/// By the divergence theorem, mm^3.
[[nodiscard]] double mesh_volume(const MeshStock& mesh);
/// As material_along().
[[nodiscard]] std::vector<std::vector<Interval>> mesh_along(const MeshStock& mesh, const RayGrid& grid);

} // namespace millwright::simulation
