// Ways through a medial axis that follow each of its edges once, with few beginnings.
#pragma once

#include "core/plot/carving/medial_axis.h"

#include <vector>

namespace millwright::plot::internal {

struct AxisTrail {
    int part = 0;
    std::vector<Vec3> way; ///< x, y, clearance; a single place of a node without edges
};

[[nodiscard]] std::vector<AxisTrail> axis_trails(const MedialAxis& axis);

} // namespace millwright::plot::internal
