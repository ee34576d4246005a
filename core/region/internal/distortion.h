// How a flat sheet differs from the sheet in space.
#pragma once

#include "core/region/flattening.h"

namespace millwright::region {

/// Fills in distortion, area ratio and folds. Onto the square each axis has its own scale, else both the
/// same.
void measure(const FaceMesh& mesh, Flattening& flattening);

} // namespace millwright::region
