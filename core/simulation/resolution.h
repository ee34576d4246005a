// How finely a stock is divided where nobody says it, and how much memory that may take. Lengths mm.
#pragma once

#include "core/geometry/vectors.h"

#include <cstddef>

namespace millwright::simulation {

/// Bytes for a field: `wanted_mb` megabytes, and at most four fifths of the memory that is free.
[[nodiscard]] std::size_t field_memory(double wanted_mb);

/// The longest edge of the box / 400, or as finely as fits into `bytes`.
[[nodiscard]] double usual_resolution(const Box3& box, std::size_t bytes);

} // namespace millwright::simulation
