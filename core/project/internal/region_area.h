// Whether an outline that a person has drawn encloses anything.
#pragma once

#include "core/geometry/vectors.h"

#include <vector>

namespace millwright::project {

/// By the even-odd rule over the unit square, as grid::Region has it: false for corners in a line, and for
/// an outline that goes back the way it came. Corners have u and v from 0 to 1.
[[nodiscard]] bool encloses_area(const std::vector<Vec2>& outline);

} // namespace millwright::project
