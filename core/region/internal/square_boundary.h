// The boundary of a sheet on the four sides of the unit square, and the search for its corners.
#pragma once

#include "core/region/flattening.h"
#include "core/region/internal/sheet_equations.h"

#include <vector>

namespace millwright::region {

/// Length of the boundary from its first point up to each, and at the end all of it, mm.
[[nodiscard]] std::vector<double> boundary_lengths(const FaceMesh& mesh);

/// Places of the points of the boundary: each side by its length. Throws Defect unless the corners are four
/// points of it that follow each other counter-clockwise.
[[nodiscard]] std::vector<Vec2> square_boundary(const std::vector<double>& lengths,
                                                const SheetCorners& corners);

/// Places of all points; measured.
[[nodiscard]] Flattening onto_square(const FaceMesh& mesh,
                                     const InnerSolver& solver,
                                     const SheetCorners& corners,
                                     FlatteningMethod method);

} // namespace millwright::region
