// The surface over a net of parameters, with a number at each node that is spread over it.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/trim.h"
#include "core/grid/node_array.h"
#include "ui/render/mesh_drawer.h"

#include <span>

namespace millwright::viewport {

/// Between nodes parameters and `values` ([rows x columns] of `nodes`) are blended; the cells of the mesh
/// divide those of the net and end exactly at the outlines of `trim`.
[[nodiscard]] render::MeshBuffer value_surface(const geometry::ParametricSurface& patch,
                                               const geometry::Trim& trim,
                                               const grid::NodeArray& nodes,
                                               std::span<const double> values);

} // namespace millwright::viewport
