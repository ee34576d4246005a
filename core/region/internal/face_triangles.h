// The triangles of one face between given points of its border.
#pragma once

#include "core/region/internal/side_welding.h"

namespace millwright::region {

/// Adds the points inside, about `spacing` mm apart, and the triangles of face `face`, counter-clockwise in
/// its parameters.
void add_triangles(int face, const ExactFace& of, const WeldedSides& welded, double spacing, FaceMesh& mesh);

} // namespace millwright::region
