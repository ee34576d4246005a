// What is cut of each part of a project's surface.
#pragma once

#include "core/project/project.h"

#include <vector>

namespace millwright::project {

/// Of the face, or of the patches; those that are missing leave all of the part.
[[nodiscard]] inline std::vector<geometry::Trim> part_trims(const SurfaceInput& input) {
    return input.face ? std::vector{input.face->trim} : input.trims;
}

} // namespace millwright::project
