// A sheet of triangles spread out flat: its outline goes to the sides of the unit square, its inside follows
// harmonically (Tutte 1963; weights of Pinkall and Polthier 1993, held above zero so that nothing folds).
#pragma once

#include "core/exchange/internal/visible_side.h"

#include <array>
#include <optional>
#include <vector>

namespace millwright::exchange {

/// A piece of the outline: two points of the mesh that follow each other, and the side of the square it lies
/// on.
struct OutlineEdge {
    int from = 0;
    int to = 0;
    int side = 0; ///< 0: v = 0, 1: u = 1, 2: v = 1, 3: u = 0; run through counter-clockwise
};

struct HarmonicParametrization {
    std::vector<Vec2> places; ///< (u, v) in [0,1]^2, one per point of the mesh
    std::vector<OutlineEdge> outline;
};

/// The corners of the square are the points of the outline next to those of `rectangle`. Nothing unless the
/// mesh is one sheet with one outline that has corners there, and no hole.
[[nodiscard]] std::optional<HarmonicParametrization> harmonic_parametrization(const TriangleMesh& mesh,
                                                                              const Rectangle& rectangle);

} // namespace millwright::exchange
