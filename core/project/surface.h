// The surface that a project's input describes.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/surface.h"
#include "core/project/project.h"
#include "core/region/joined_region.h"
#include "core/region/region.h"

namespace millwright::project {

/// Throws Error if a net is none of a patch.
[[nodiscard]] geometry::Surface surface_of(const SurfaceInput& input);

/// Several faces as one surface. Throws Error as region::joined_region and for a trimmed face; Cancelled.
[[nodiscard]] region::JoinedRegion joined_region(const JoinedInput& input, const Progress& progress);

/// What the tool path covers: the face, or the machined patch, with its outlines, or the joined faces, which
/// takes about a second. Throws the same, and Error if there is no such patch.
[[nodiscard]] region::Region machined_region(const SurfaceInput& input,
                                             const Progress& progress = Progress());

} // namespace millwright::project
