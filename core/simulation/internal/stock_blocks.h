// What is left of the stock as boxes, for contacts that a mesh of its surface would miss: the lines are taken
// together in cubes of a few cells, and all material that any line has in a cube lies within its box. So
// boxes hold more than there is, by less than a cube. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/collision_mesh.h"
#include "core/simulation/dexel_field.h"

#include <cstddef>

namespace millwright::simulation {

struct StockBlocks {
    CollisionTriangles surface; ///< closed boxes; none where all cubes around are full
    int stride = 1;             ///< cells along the edge of a cube
};

/// With so many triangles at most; cubes of `least` cells or more grow until it fits. Throws Cancelled.
[[nodiscard]] StockBlocks
blocks_of(const DexelField& field, std::size_t most_triangles, int least, const Progress& progress);

} // namespace millwright::simulation
