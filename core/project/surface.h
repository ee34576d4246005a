// The surface that a project's input describes.
#pragma once

#include "core/geometry/surface.h"
#include "core/project/project.h"

namespace millwright::project {

/// Throws Error if a net is none of a patch.
[[nodiscard]] geometry::Surface surface_of(const SurfaceInput& input);

} // namespace millwright::project
