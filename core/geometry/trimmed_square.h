// Triangles of the parameters of a trimmed patch whose edges follow its outlines exactly.
#pragma once

#include "core/geometry/trim.h"

#include <array>
#include <vector>

namespace millwright::geometry {

/// Triangles of [0,1]^2, counterclockwise. Every edge belongs to two of them or lies on the border of the
/// square: however they are moved, no crack opens between them.
struct TrimmedSquare {
    std::vector<Vec2> places;
    std::vector<std::array<int, 3>> inside;  ///< of what the outlines leave
    std::vector<std::array<int, 3>> outside; ///< the rest
};

/// Two triangles for each of nu x nv equal cells, more where an outline comes through one. Loops that cross
/// themselves or each other are followed exactly up to 1,000 crossings beside each other in a row of cells,
/// beyond that to within the slices of the row. Throws Defect if nu or nv < 1.
[[nodiscard]] TrimmedSquare trimmed_square(const Trim& trim, int nu, int nv);

} // namespace millwright::geometry
