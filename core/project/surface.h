// The surface that a project's input describes.
#pragma once

#include "core/geometry/surface.h"
#include "core/project/project.h"
#include "core/region/region.h"

namespace millwright::project {

/// Throws Error if a net is none of a patch.
[[nodiscard]] geometry::Surface surface_of(const SurfaceInput& input);

/// What the tool path covers: the face, or the machined patch, with its outlines. The same throws, and Error
/// if there is no such patch.
[[nodiscard]] region::Region machined_region(const SurfaceInput& input);

} // namespace millwright::project
